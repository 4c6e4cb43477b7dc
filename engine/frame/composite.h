// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "frame/compose_context.h"
#include "frame/composed_frame.h"
#include "frame/intruder_layers.h"
#include "scene/scene.h"

namespace sigs {

// Composites the intruders onto the background by the scene's method, far to near. Fills image, mask, stages and
// op_counts.
//   background  its samples are rewritten in place, so they must not be shared
//   frame       number of the frame in the footage
[[nodiscard]] ComposedFrame composited(Frame background, const Scene& scene, int frame,
                                       const std::vector<IntruderLayers>& far_to_near, ComposeContext& context,
                                       Stages stages);

}  // namespace sigs
