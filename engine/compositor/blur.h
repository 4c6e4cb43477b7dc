// SPDX-License-Identifier: MIT
#pragma once

#include "base/layer.h"

namespace sigs {

// Blurs as the lens does at distance. Works on premultiplied colour, so the sky never bleeds in. The rectangle grows by
// blur_reach_px(sigma_px) on every side; coverage, the truth, is not softened. sigma_px == 0 returns the layer
// unchanged. The kernel is cut at three sigmas and sums to one: energy is kept.
[[nodiscard]] Layer blurred(const Layer& layer, double sigma_px);

// How far blur carries a pixel: ceil(3 sigma_px).
[[nodiscard]] int blur_reach_px(double sigma_px);

}  // namespace sigs
