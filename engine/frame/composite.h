// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
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

// Whether anything follows the blending: the halo of a thermal camera, sharpening, chroma blur, grain.
[[nodiscard]] bool has_post_blend_stages(const Scene& scene);

// How far these stages carry a change beyond the layer, px; the halo counts up to max_halo_px.
[[nodiscard]] int post_blend_stages_margin_px(const Scene& scene, PixelLayout layout,
                                              int max_halo_px = std::numeric_limits<int>::max());

// Called with the name of each stage that is not left out, when the frame holds its result.
using StageDone = std::function<void(const std::string& name)>;

// Blends a layer of an intruder onto the frame, and then, on what that changes in code values and before it is
// rounded: sharpening, chroma blur, grain. Only samples within the layer and the reach of these stages are
// rewritten; those that the own body hides wholly keep their bits. Gives back which pixels are rewritten (write_patch):
// CV_8UC1, 255 or 0, over `rect`.
//   layer   within the image
//   space   that it is mixed in
//   intruder, number  the intruder's number, and that of the frame in the footage, for the grain
//   done    may be empty; otherwise every stage is written into the frame on its way
struct Rewritten {
  cv::Rect rect;
  cv::Mat changed;
};
[[nodiscard]] Rewritten blend_with_post_blend_stages(ComposedFrame& composed, const Scene& scene, const Layer& layer,
                                                     BlendChoice space, int intruder, int number,
                                                     const StageDone& done);

}  // namespace sigs
