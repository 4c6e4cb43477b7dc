// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "base/image.h"
#include "frame/composed_frame.h"
#include "scene/scene.h"

namespace sigs {

// Whether anything follows the blending: the halo of a thermal camera, sharpening, chroma blur, grain.
[[nodiscard]] bool has_post_blend_stages(const Scene& scene);

// How far these stages carry a change beyond the layer, px.
[[nodiscard]] int post_blend_stages_margin_px(const Scene& scene, PixelLayout layout);

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
