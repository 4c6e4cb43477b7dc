// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "frame/intruder_layers.h"
#include "scene/scene.h"
#include "truth/annotation.h"
#include "video/frame.h"

namespace sigs {

// Luma of the footage where an intruder will be blended onto it, and around.
struct FootageLuma {
  int id = 0;  // of the intruder
  cv::Rect rect;
  cv::Mat luma;  // CV_8UC1 over rect, of its own
};

// One for each intruder that will be blended. To be called before that, since blending rewrites the footage in place.
[[nodiscard]] std::vector<FootageLuma> footage_luma_of(const Frame& footage,
                                                       const std::vector<IntruderLayers>& far_to_near);

// Fills IntruderTruth::detectability (truth/detectability.h) of the intruders that can be seen.
//   image  the frame with the intruders
void add_detectability(std::vector<IntruderTruth>& intruders, const Frame& image,
                       const std::vector<FootageLuma>& footage, const Scene& scene);

}  // namespace sigs
