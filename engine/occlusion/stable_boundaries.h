// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "occlusion/stable_motion.h"

namespace sigs {

// Where a body can end; CV_32FC1, 0 nowhere near .. 1 surely here.
struct Boundaries {
  cv::Mat staying;  // edges that stay, as wide as they are seen
  cv::Mat ridge;    // their middles: where exactly
  cv::Mat ending;   // places where motion ends within a few pixels, whatever the contrast there; as wide as they are
  cv::Mat motion;   // their middles, with a lower bar
};

[[nodiscard]] Boundaries boundaries_of(const Motion& motion);

}  // namespace sigs
