// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace sigs {

// How the 8-bit samples of an image lie.
enum class PixelLayout {
  gray,    // plane 0: luma
  yuv420,  // planes Y, Cb, Cr; chroma halved both ways, rounded up
  yuv422,  // chroma halved in x, rounded up
  yuv444,
  rgb,  // planes red, green, blue, full range
};

enum class ColorRange { limited, full };          // luma 16..235 or 0..255
enum class ColorMatrix { bt601, bt709, bt2020 };  // Y'CbCr coefficients; bt2020 is the non-constant-luminance one

// Where a chroma sample sits among its luma samples: of 4:2:0 on a column, midway between two rows; midway both ways;
// on a pixel. Of 4:2:2 on a column; midway between two; on a column.
enum class ChromaSite { left, center, top_left };

// What the samples mean. Carried from the footage to the output unchanged.
struct ColorInfo {
  ColorRange range = ColorRange::limited;
  ColorMatrix matrix = ColorMatrix::bt709;
  ChromaSite chroma_site = ChromaSite::left;
  int primaries = 2;  // ISO/IEC 23091-2 code points, 2: unspecified
  int transfer = 2;
  bool matrix_stated = false;  // false: the file does not say, the matrix above is assumed from the image's height
  bool range_stated = false;

  [[nodiscard]] bool operator==(const ColorInfo&) const = default;
};

// One image of the footage in its own planes, CV_8UC1 each. Unused planes are empty.
struct Frame {
  PixelLayout layout = PixelLayout::yuv420;
  ColorInfo color;
  std::array<cv::Mat, 3> planes{};
  double time_s = 0;     // presentation time, 0 at the footage's first frame
  bool damaged = false;  // the footage's own frame is damaged: another one, which is intact, stands in for it

  [[nodiscard]] cv::Size size_px() const { return planes[0].size(); }
  [[nodiscard]] int plane_count() const { return layout == PixelLayout::gray ? 1 : 3; }
};

// cv::Mat shares its samples; this shares nothing.
[[nodiscard]] Frame cloned(const Frame& frame);

// A frame whose samples are all 0.
[[nodiscard]] Frame blank_frame(PixelLayout layout, cv::Size size_px, const ColorInfo& color);

// How many luma samples one chroma sample spans, in x and y: {2, 2} for yuv420, {1, 1} for layouts without subsampling.
[[nodiscard]] cv::Size chroma_step(PixelLayout layout);

// Linear map between code values and R'G'B' in 0..1: rgb = to_rgb * (code - offset), code = from_rgb * rgb + offset.
// For gray the first row and column are all there is (luma alone, R' = G' = B'); for rgb it is a division by 255.
struct CodeToRgb {
  cv::Matx33f to_rgb;
  cv::Matx33f from_rgb;
  cv::Vec3f offset;
};
[[nodiscard]] CodeToRgb code_to_rgb(PixelLayout layout, const ColorInfo& color);

// Whole images as 8-bit BGR (OpenCV's order), chroma read at its own site (bilinear), and back (chroma averaged at
// its site). For showing, for PNG files and for the classic method; the direct method never converts a whole image.
[[nodiscard]] cv::Mat bgr_of(const Frame& frame);
[[nodiscard]] Frame frame_of_bgr(const cv::Mat& bgr, PixelLayout layout, const ColorInfo& color);

}  // namespace sigs
