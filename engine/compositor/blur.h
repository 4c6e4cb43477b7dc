// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "base/image.h"
#include "compositor/gaussian_kernel.h"
#include "video/frame.h"

namespace sigs {

// Blurs as the lens does at distance. Works on premultiplied colour, so the sky never bleeds in. The rectangle grows by
// blur_margin_px(sigma_px) on every side; coverage, the truth, is not blurred. sigma_px == 0 returns the layer
// unchanged. The kernel is a Gaussian on whole pixels with the variance sigma_px^2, also far below a pixel; cut at
// three sigmas, which takes up to 2.7 % of the variance, and of sum one: energy is kept. What it leaves at an edge is
// at most 8 % of the step (at sigma 0.4; 2 % from 1 on, half a percent from 2 on) away from the light blurred before
// pixels average it.
[[nodiscard]] Layer blurred(const Layer& layer, double sigma_px);

// The same with a sigma of its own along each axis.
[[nodiscard]] Layer blurred(const Layer& layer, const glm::dvec2& sigma_px);

// Above this sigma a blur is computed at positions a quarter of sigma apart, and the cost no longer grows with sigma.
inline constexpr double kWideSigma_px = 16;

// The same blur for any sigma above kWideSigma_px, 1e30 px too, over target's pixels alone. It differs from blurred()
// by at most 1.2 % of the highest value, where the kernel's cut (a step of exp(-4.5)) comes out soft, and by less than
// 0.5 % in the root of the mean square.
[[nodiscard]] Layer widely_blurred(const Layer& layer, double sigma_px, const cv::Rect& target);

// The blur of any sigma, over the pixels of `image` alone: blurred() or, above kWideSigma_px, widely_blurred().
//   spread_px2  variance along each axis that the layer has been spread by already; the blur has so much less of it
[[nodiscard]] Layer blurred_within(const Layer& layer, double sigma_px, const cv::Rect& image,
                                   const glm::dvec2& spread_px2 = {0, 0});

// Upper bound of any channel of any pixel after a blur above kWideSigma_px.
[[nodiscard]] double max_after_blur(const Layer& layer, double sigma_px);

// False where a wide blur leaves the layer too faint to change any sample of a footage with these colours and this
// depth.
[[nodiscard]] bool is_visible_after_blur(const Layer& layer, double sigma_px, const ColorInfo& footage,
                                         int bit_depth = 8);

}  // namespace sigs
