// SPDX-License-Identifier: MIT
#pragma once

#include "base/image.h"

namespace sigs {

// The intruder's own colours as the footage's camera shows them, in linear light.
//   saturation  1: as painted; 0: gray of the same luminance (BT.709's); channels that would become negative are 0
//   black       light that the lens' flare adds to everything in front of it. The footage has it already; of a layer it
//               is added by opacity, so the darkest part of an opaque intruder is as bright as the footage's darkest
// Opacity and coverage are unchanged. Saturation 1 and black 0 return the layer, with its samples shared.
[[nodiscard]] Layer toned(const Layer& layer, double saturation, double black);

}  // namespace sigs
