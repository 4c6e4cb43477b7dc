// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "base/image.h"
#include "base/pose.h"
#include "camera/lens.h"
#include "camera/lens_table.h"
#include "compositor/codec_match.h"
#include "frame/composed_frame.h"
#include "frame/render_plan.h"
#include "scene/scene.h"

namespace sigs {

// Composites the intruders onto the background by the scene's method, far to near. Fills image, mask, stages and
// op_counts.
//   background  its samples are rewritten in place, so they must not be shared
//   frame       number of the frame in the footage
[[nodiscard]] ComposedFrame composited(Frame background, const Scene& scene, int frame,
                                       const std::vector<IntruderLayers>& far_to_near, ComposeContext& context,
                                       Stages stages);

// The occluder's mask as the camera sees it from another pose: CV_32FC1 over rect, a part of the image. Each pixel's
// ray is followed to the occluder's distance or, where that is 0, to infinity, and the mask is read there between its
// pixels. 0 where the camera did not look when the mask was made, and where the occluder is nearer than the camera has
// moved. From the mask's own pose it is the mask itself, bit for bit.
// A rolling shutter's rows are taken at the frame's time.
[[nodiscard]] cv::Mat occluder_seen_from(const Pose<frame::World, frame::Camera>& world_from_camera,
                                         const Occluder& occluder, LensTable& lens, const cv::Rect& rect);

}  // namespace sigs
