// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "frame/composed_frame.h"
#include "frame/render_plan.h"
#include "scene/scene.h"
#include "scene/scene_at.h"
#include "truth/annotation.h"
#include "video/frame.h"

namespace sigs {

// Luma of the footage where an intruder will be blended onto it, and around. Empty where it will not be.
struct FootageLuma {
  cv::Rect rect;
  cv::Mat luma;  // CV_8UC1 over rect, of its own
};

// Of each intruder. To be called before they are blended, since that rewrites the footage in place.
[[nodiscard]] std::vector<FootageLuma> footage_luma_of(const Frame& footage,
                                                       const std::vector<IntruderLayers>& far_to_near);

// The truth of a frame: what is measured in the composed image, and what the scene says. Intruders by id.
//   frame         number of the frame in the footage
//   footage_luma  of each of far_to_near, before they were blended
[[nodiscard]] FrameTruth frame_truth(const Scene& scene, const SceneMoment& moment, int frame,
                                     const ComposedFrame& composed, const std::vector<IntruderLayers>& far_to_near,
                                     const std::vector<FootageLuma>& footage_luma);

}  // namespace sigs
