// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <string>

#include "base/image.h"
#include "frame/composed_frame.h"
#include "scene/scene.h"
#include "video/frame.h"

// What a scene's appearance does to light, of everything that is put into the footage: before it is blended, and after.
namespace sigs {

// Share of an object's own light that gets through the scene's haze: that of lamps, and what a shadow takes.
[[nodiscard]] double light_through_haze(const Scene& scene, double distance_m);

// A layer in the footage's tones and behind its haze: the body, in pixels or in finer samples, and contrails. A method
// that has no look, or settings that change nothing, return the layer, with its samples shared.
//   distance_m  of all of it, or of each pixel: CV_32FC1 over the layer
//   box         of the pixels of the image that it takes up, around which the haze's colour may be read
//   background  none: the colour of the settings
[[nodiscard]] Layer in_footage_look(const Scene& scene, const Layer& layer, double distance_m, const cv::Rect& box,
                                    const Frame* background);
[[nodiscard]] Layer in_footage_look(const Scene& scene, const Layer& layer, const cv::Mat& distance_m,
                                    const cv::Rect& box, const Frame* background);

// Whether anything follows the blending: the halo of a thermal camera, sharpening, chroma blur, grain.
[[nodiscard]] bool has_post_blend_stages(const Scene& scene);

// How far these stages carry a change beyond the layer, px; the halo counts up to max_halo_px.
[[nodiscard]] int post_blend_stages_margin_px(const Scene& scene, PixelLayout layout,
                                              int max_halo_px = std::numeric_limits<int>::max());

// Called with the name of each stage that is not left out, when the frame holds its result.
using StageDone = std::function<void(const std::string& name)>;

struct Rewritten {
  cv::Rect rect;
  cv::Mat changed;
};
// Blends a layer of an intruder onto the frame, and then, on what that changes in code values and before it is
// rounded: sharpening, chroma blur, grain. Only samples within the layer and the reach of these stages are
// rewritten; those that the own body hides wholly keep their bits. Gives back which pixels are rewritten (write_patch):
// CV_8UC1, 255 or 0, over `rect`.
//   layer   within the image
//   space   that it is mixed in
//   intruder, number  the intruder's number, and that of the frame in the footage, for the grain
//   done    may be empty; otherwise every stage is written into the frame on its way
[[nodiscard]] Rewritten blend_with_post_blend_stages(ComposedFrame& composed, const Scene& scene, const Layer& layer,
                                                     BlendChoice space, int intruder, int number,
                                                     const StageDone& done);

}  // namespace sigs
