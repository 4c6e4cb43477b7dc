// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/image.h"
#include "video/frame.h"

namespace sigs::test {

// One way in which the samples of an image lie and what they mean.
struct Sort {
  std::string name;
  PixelLayout layout = PixelLayout::yuv420;
  cv::Size step{1, 1};  // luma samples a chroma sample
  bool is_limited = true;
  ColorMatrix matrix = ColorMatrix::bt709;
  ChromaSite site = ChromaSite::left;
};

// Every layout in both ranges and all matrices; where chroma is halved, each site it can have.
[[nodiscard]] std::vector<Sort> all_sorts();

[[nodiscard]] Frame grainy(const Sort& sort, cv::Size size_px);

// One luma code everywhere (for rgb: in all three planes), no colour.
[[nodiscard]] Frame even(const Sort& sort, cv::Size size_px, uchar code);

// IEC 61966-2-1 and Rec. ITU-R BT.601, 709 and 2020 written out again, in doubles.
[[nodiscard]] double display_value(double linear);
[[nodiscard]] double linear_value(double display);
[[nodiscard]] cv::Vec3d codes_of(const Sort& sort,
                                 const cv::Vec3d& display);  // not rounded; luma alone counts for gray

// What a column (row) of pixels adds to a chroma sample that is the average of an image's pixels around it.
struct Share {
  int pixel = 0;
  double weight = 0;
};

// Which columns (rows) of an image `pixels` wide (high) a chroma sample averages: 1/2 1/2 of the two that it lies
// between, 1/4 1/2 1/4 of the one it lies on and its neighbours. The outermost pixel is repeated beyond the edge.
[[nodiscard]] std::vector<Share> shares_across(const Sort& sort, int chroma, int pixels);
[[nodiscard]] std::vector<Share> shares_down(const Sort& sort, int chroma, int pixels);

// Whether a sample of a plane has any pixel of opacity above 0 among those that it is made of.
[[nodiscard]] bool is_covered(const Layer& layer, int x, int y, int plane, const Sort& sort, cv::Size size_px);

}  // namespace sigs::test
