// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/layer.h"
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
// Light is taken from code values and back by the footage's transfer function and primaries (footage_light.h).
// The layer lies within the image. Gives back how many pixels were rewritten.
std::int64_t blend_over(Frame& frame, const Layer& layer, BlendSpace space);

}  // namespace sigs
