// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "frame.h"
#include "see_intruder.h"

namespace sigs {

// Lays the intruders on the background by the scene's method, far to near. Fills picture, mask and stages.
[[nodiscard]] ComposedFrame laid_on(const Frame& background, const Scene& scene,
                                    const std::vector<SeenIntruder>& far_to_near, Bench& bench, Stages stages);

}  // namespace sigs
