// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/lens.h"
#include "compositor/codec_match.h"
#include "frame/composed_frame.h"
#include "frame/intruder_layers.h"
#include "scene/scene.h"

namespace sigs {

// Whether anything follows the blending: sharpening, chroma blur, grain.
[[nodiscard]] bool has_post_blend_stages(const AppearanceSettings& appearance);

// How far these stages carry a change beyond the layer, px.
[[nodiscard]] int post_blend_stages_margin_px(const AppearanceSettings& appearance, PixelLayout layout);

// Called with the name of each stage that is not left out, when the frame holds its result.
using StageDone = std::function<void(const std::string& name)>;

// Blends an intruder's occluded layer onto the frame, and then, on what that changes in code values and before it is
// rounded: sharpening, chroma blur, grain. Only samples within the layer and the reach of these stages are
// rewritten; those that the own body hides wholly keep their bits. Gives back which pixels are rewritten (write_patch):
// CV_8UC1, 255 or 0, over `rect`.
//   number  of the frame in the footage, for the grain
//   done    may be empty; otherwise every stage is written into the frame on its way
struct Rewritten {
  cv::Rect rect;
  cv::Mat changed;
};
[[nodiscard]] Rewritten blend_with_post_blend_stages(ComposedFrame& composed, const Scene& scene,
                                                     const IntruderLayers& layers, int number, const StageDone& done);

// The codec match of a frame as the scene's settings (appearance.codec) ask for it, to be made before the layers are
// blended and applied after; nothing where there is none to be done: it is not asked for, the method is not direct, the
// footage has more than 8 bits, its codec keeps every sample, or no intruder reaches the image.
//   frame  number of the frame in the footage
//   lens   that the scene is composited with
[[nodiscard]] std::optional<CodecMatch> codec_match_for(const Frame& background, const Scene& scene, int frame,
                                                        const Lens& lens, const std::vector<IntruderLayers>& layers);

}  // namespace sigs
