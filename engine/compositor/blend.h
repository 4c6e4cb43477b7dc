// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "base/image.h"
#include "compositor/float_patch.h"
#include "video/frame.h"

namespace sigs {

enum class BlendSpace {
  linear,   // light adds, as in the lens
  display,  // code values are mixed, as the paper does
};

// Composites the layer over the frame, in the frame's own planes. Only samples that the layer covers are converted and
// rewritten; every other sample keeps its bits. A luma sample is covered where the opacity of its pixel is above 0, a
// chroma sample where that of any pixel is that it averages at its site (video/chroma.h): for 4:2:0 at the left, three
// columns by two rows. The background's chroma is read between its samples, as it was before.
// Code values are converted to light and back by the footage's transfer function and primaries (video/color_space.h).
// The layer lies within the image. Gives back how many pixels were rewritten.
std::int64_t blend_over(Frame& frame, const Layer& layer, BlendSpace space);

// The same into a copy of the samples around the layer, not rounded (compositor/float_patch.h), for stages that work on
// what the layer changes. The frame stays as it is.
//   margin_px  of the copy beyond the layer, on each side
//   own_body   as for patch_of()
[[nodiscard]] FloatPatch blended_patch(const Frame& frame, const Layer& layer, BlendSpace space, int margin_px,
                                       const cv::Mat& own_body);

// Puts pixels of an 8-bit BGR image into the frame's own planes, in the part of it that rect names. Gives back how
// many were rewritten.
//   bgr     of rect's size
//   weight  CV_32FC1 of rect's size: 0 leaves the pixel's samples as they are, 1 replaces them, between mixes
std::int64_t replace_pixels(Frame& frame, const cv::Rect& rect, const cv::Mat& bgr, const cv::Mat& weight);

// The same over the whole image.
std::int64_t replace_pixels(Frame& frame, const cv::Mat& bgr, const cv::Mat& weight);

}  // namespace sigs
