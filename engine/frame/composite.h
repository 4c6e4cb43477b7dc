// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "frame/compose_frame.h"
#include "frame/render_intruder.h"

namespace sigs {

// Composites the intruders onto the background by the scene's method, far to near. Fills image, mask, stages and work.
//   background  nobody else shares its samples: they are written over
[[nodiscard]] ComposedFrame composited(Frame background, const Scene& scene,
                                       const std::vector<IntruderLayers>& far_to_near, ComposeContext& context,
                                       Stages stages);

}  // namespace sigs
