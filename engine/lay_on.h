// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "frame.h"
#include "see_intruder.h"

namespace sigs {

// Lays the intruders on the background by the scene's method, far to near. Fills picture, mask, stages and work.
//   background  nobody else shares its samples: they are written over
[[nodiscard]] ComposedFrame laid_on(Frame background, const Scene& scene, const std::vector<SeenIntruder>& far_to_near,
                                    Bench& bench, Stages stages);

}  // namespace sigs
