// SPDX-License-Identifier: MIT
#pragma once

#include "base/layer.h"

namespace sigs {

// Blurs as the lens does at distance. Works on premultiplied colour, so the sky never bleeds in. The rectangle grows by
// blur_reach_px(sigma_px) on every side; coverage, the truth, is not softened. sigma_px == 0 returns the layer
// unchanged. The kernel is a Gaussian on whole pixels with the variance sigma_px^2, also far below a pixel; cut at
// three sigmas, which takes up to 2.7 % of the variance, and of sum one: energy is kept. What it leaves at an edge is
// at most 8 % of the step (at sigma 0.4; 2 % from 1 on, half a percent from 2 on) away from the light blurred before
// pixels average it.
[[nodiscard]] Layer blurred(const Layer& layer, double sigma_px);

// How far blur carries a pixel: ceil(3 sigma_px).
[[nodiscard]] int blur_reach_px(double sigma_px);

// Above this sigma a layer is made in cells, pixels of a coarser grid, and blurred from there: what the kernel takes
// away needs no pixels of its own, and the cost no longer grows with sigma.
inline constexpr double kSigmaOfCells_px = 16;

// How large a cell may be: an eighth of sigma, which leaves errors below a thousandth of the opacity.
[[nodiscard]] double largest_cell_px(double sigma_px);

// The same blur of a layer that is given in cells, over target's pixels, for any sigma from kSigmaOfCells_px on, 1e30
// px too. It differs from blurred() by at most 1.2 % of the highest value, where the kernel's cut (a step of exp(-4.5))
// comes out soft, and by less than 0.5 % in the root of the mean square. Coverage, which cells are too coarse for, is
// 0.
//   cells    cell (i, j) covers the square [i, i + 1) x [j, j + 1) times cell_px, from the upper left picture corner
//   cell_px  1 to largest_cell_px(sigma_px); small against the layer too, which else is shifted by a part of a cell
[[nodiscard]] Layer blurred_from_cells(const Layer& cells, double cell_px, double sigma_px, const cv::Rect& target);

// The layer in cells of cell_px by cell_px pixels: their means, so that the energy stays. Coverage stays behind.
[[nodiscard]] Layer in_cells(const Layer& layer, int cell_px);

// Upper bound of any channel of any pixel after that blur.
[[nodiscard]] double most_after_blur(const Layer& cells, double cell_px, double sigma_px);

}  // namespace sigs
