// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "base/image.h"
#include "video/frame.h"

namespace sigs {

// The pixels of one target (an aircraft in the sky, say) in one frame, told from the background around it. Only the
// frame and a loose box are used, no truth, so that a real and an inserted target are treated alike.
struct TargetSilhouette {
  cv::Rect patch;                        // part of the image that all of the following cover
  cv::Mat mask;                          // CV_8UC1 over patch: 255 where the target is
  cv::Mat difference;                    // CV_32FC1 over patch: luma minus the background's, 8-bit code values
  cv::Mat distance_px;                   // CV_32FC1 over patch: from the nearest pixel of the mask; 0 on it
  cv::Mat cb_difference, cr_difference;  // CV_32FC1 over patch, the same of Cb and Cr, at chroma's own resolution but
                                         // read between its samples; empty for gray footage
  cv::Mat cb, cr;                        // CV_32FC1, Cb and Cr themselves; empty for gray footage
  cv::Rect box;                          // smallest box of the mask, in the image
  double background = 0;                 // luma of the background, mean over the mask
  double background_sd = 0;              // robust standard deviation of the luma about the background around the target
  double chroma_sd = 0;                  // the same of Cb and Cr, the larger one
  bool is_cut = false;  // the largest piece touches the given box's edge: the box may not hold the whole target
};

// Tells the target in `box` from the background. The background is a surface of second order through the luma outside
// of the box, fitted without outliers; the target is what differs by more than 4.5 of its standard deviations, 5 code
// values at least, without specks. Chroma is treated by the same surface fit.
// None where less than 12 pixels differ, where the box lies outside the image, or where less than half of the
// surroundings lie within it.
//   box  continuous pixels; may be loose by up to its own size
[[nodiscard]] std::optional<TargetSilhouette> target_silhouette(const Frame& frame, const Box& box);

// Profiles of luma and chroma across a target's outline, from the inside to the outside.
struct EdgeProfiles {
  int count = 0;                    // profiles that could be used
  std::optional<double> width_px;   // 10 to 90 % of the contrast, median
  std::optional<double> slope;      // largest slope over the contrast, 1/px, upper quartile
  std::optional<double> overshoot;  // lowest value of the mean profile beyond 10 %, negated, share of the contrast
  std::optional<double> chroma_width_px;  // 10 to 90 % of Cb and Cr along the target's mean chroma difference, median
};

// At each pixel of the outline one profile along the outline's normal, 6 px to each side, read with bicubic
// interpolation. The contrast is that of the first extremum within the outline. Profiles with little contrast, and
// those that do not come to rest outside, are left out; without 6 usable ones nothing is known.
[[nodiscard]] EdgeProfiles edge_profiles(const TargetSilhouette& target);

// Another place in a frame whose background is like that around a box, for a second target beside the one in the box:
// of the places where a rectangle of size_px and 14 px around it lie within the image and 8 px or more away from the
// box, one of the three whose luma is most alike in mean and standard deviation. None where there is no place.
//   seed  chooses among the three
[[nodiscard]] std::optional<cv::Point2d> similar_place(const Frame& frame, const Box& box, cv::Size size_px,
                                                       std::uint32_t seed);

}  // namespace sigs
