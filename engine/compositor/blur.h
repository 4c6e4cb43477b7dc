// SPDX-License-Identifier: MIT
#pragma once

#include "base/layer.h"

namespace sigs {

// Blurs as the lens does at distance. Works on premultiplied colour, so the sky never bleeds in. The rectangle grows by
// blur_margin_px(sigma_px) on every side; coverage, the truth, is not blurred. sigma_px == 0 returns the layer
// unchanged. The kernel is a Gaussian on whole pixels with the variance sigma_px^2, also far below a pixel; cut at
// three sigmas, which takes up to 2.7 % of the variance, and of sum one: energy is kept. What it leaves at an edge is
// at most 8 % of the step (at sigma 0.4; 2 % from 1 on, half a percent from 2 on) away from the light blurred before
// pixels average it.
[[nodiscard]] Layer blurred(const Layer& layer, double sigma_px);

// How far blur carries a pixel: ceil(3 sigma_px).
[[nodiscard]] int blur_margin_px(double sigma_px);

// Above this sigma a layer is made of coarse pixels (squares of several pixels a side) and blurred from there: what the
// kernel takes away needs no pixels of its own, and the cost no longer grows with sigma.
inline constexpr double kCoarseBlurSigma_px = 16;

// How large a coarse pixel may be, in pixels a side: an eighth of sigma, which leaves errors below a thousandth of the
// opacity.
[[nodiscard]] double max_coarse_step_px(double sigma_px);

// The same blur of a layer that is given in coarse pixels, over target's pixels, for any sigma from kCoarseBlurSigma_px
// on, 1e30 px too. It differs from blurred() by at most 1.2 % of the highest value, where the kernel's cut (a step of
// exp(-4.5)) comes out soft, and by less than 0.5 % in the root of the mean square. Coverage, which coarse pixels are
// too large for, is 0.
//   coarse_layer  coarse pixel (i, j) covers the square [i, i + 1) x [j, j + 1) times step_px, from the upper left
//   image corner step_px  1 to max_coarse_step_px(sigma_px); small against the layer too, which else is shifted by a
//   part of a coarse pixel
[[nodiscard]] Layer blurred_from_coarse(const Layer& coarse_layer, double step_px, double sigma_px,
                                        const cv::Rect& target);

// The layer in coarse pixels of step_px by step_px pixels: their means, so that the energy stays. Coverage stays
// behind.
[[nodiscard]] Layer downsampled(const Layer& layer, int step_px);

// Upper bound of any channel of any pixel after that blur.
[[nodiscard]] double max_after_blur(const Layer& coarse_layer, double step_px, double sigma_px);

}  // namespace sigs
