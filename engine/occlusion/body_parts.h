// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// What tells parts of the carrying aircraft from other parts of the image; CV_32FC1, of the labels' size.
struct PartEvidence {
  cv::Mat staying;    // 0..1: edges that stay
  cv::Mat ending;     // 0..1: places where motion ends abruptly
  cv::Mat variation;  // of the gradient over time; 1: as much as noise
  cv::Mat drift;      // 0..1: what creeps
  cv::Mat middle;     // 0..1: the middles of the edges and of the ends of motion
};

struct BodyParts {
  cv::Mat kept;      // CV_8UC1, 255
  cv::Mat doubtful;  // CV_8UC1, 255: large enough, but for another reason not kept
  cv::Mat odds;      // CV_32FC1, natural logarithm: of the part that a pixel was kept with; 0 elsewhere
};

// Those connected parts of a labelling that can be the carrying aircraft's:
// - large enough,
// - at the image's border: the aircraft goes on to where the camera is fixed to it,
// - of which the following together speak more for the aircraft than against it: what separates them from the rest is
//   an edge that stays or an abrupt end of motion, with few such just outside, as a world passing by has none; they are
//   still inside, not a road, whose faint texture passes by, and no clouds that creep.
// labellings: one or more, CV_8UC1, non-zero: may be body. Where parts of several overlap, the more convincing one
// stays, with what is nearly as convincing.
[[nodiscard]] BodyParts body_parts(const std::vector<cv::Mat>& labellings, const PartEvidence& evidence,
                                   double min_area_px);

}  // namespace sigs
