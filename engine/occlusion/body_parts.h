// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs {

// What tells parts of the carrying aircraft from other parts of the picture; CV_32FC1, of the labels' size.
struct PartEvidence {
  cv::Mat staying;    // 0..1: edges that stay
  cv::Mat ending;     // 0..1: places where motion ends abruptly
  cv::Mat variation;  // of the gradient over time; 1: as much as noise
  cv::Mat drift;      // 0..1: what creeps
};

struct BodyParts {
  cv::Mat kept;      // CV_8UC1, 255
  cv::Mat doubtful;  // CV_8UC1, 255: large enough, but for another reason not kept
};

// Those connected parts of a labelling that can be the carrying aircraft's:
// - large enough,
// - at the picture's border: the aircraft goes on to where the camera is fixed to it,
// - walled off: what separates it from the rest is mostly an edge that stays or an abrupt end of motion, and where it
// is
//   only the latter, as around a sky between passing trees, more of it,
// - still inside: not a road, whose faint texture passes by, and no clouds that creep.
// labels: CV_8UC1, non-zero: may be body.
[[nodiscard]] BodyParts body_parts(const cv::Mat& labels, const PartEvidence& evidence, double least_area_px);

}  // namespace sigs
