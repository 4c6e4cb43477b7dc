// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "annotation/measure.h"
#include "camera/lens_table.h"
#include "coarse.h"

namespace sigs {

// Where the layer of a far blurred intruder is made, and what it reaches.
struct CellGrid {
  int cell_px = 1;
  cv::Rect cells;   // cell (i, j) covers the square [i, i + 1) x [j, j + 1) times cell_px, from the picture's corner
  cv::Rect target;  // pixels within the picture that its light can reach
};

// The cells that hold what blur carries into the picture. Nothing where it carries nothing there.
//   box       the silhouette, where it bounds the intruder; none: it can be anywhere
//   sigma_px  above kSigmaOfCells_px
// What lies more than 16 focal lengths beyond the picture's edges is left out: through a pinhole, 86 degrees off axis.
[[nodiscard]] std::optional<CellGrid> cell_grid(const std::optional<Box>& box, const Camera& camera,
                                                const cv::Rect& picture, double sigma_px);

// The views to draw for the grid's cells.
//   lens  of the coarse camera with a pixel for each cell
[[nodiscard]] std::vector<VirtualView> views_of_cells(const CellGrid& grid, LensTable& lens, const Sitter& sitter,
                                                      double supersampling, int max_size_px);

// The blurred layer over the grid's target; empty where it is too faint to change any 8-bit sample.
//   sharp  the part within the picture, whose coverage is taken over
//   views  for the grid's cells; none: `sharp` is the whole intruder and the cells are made of its pixels
//   lens   of the coarse camera
//   least_light  what changes no sample of the footage (video/transfer_function.h)
[[nodiscard]] Layer far_blurred(const CellGrid& grid, const Layer& sharp, std::span<const DrawnView> views,
                                LensTable& lens, double sigma_px, double least_light);

}  // namespace sigs
