// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "camera/lens_table.h"
#include "frame/render_item.h"
#include "truth/measure.h"

namespace sigs {

// Where the layer of a coarsely blurred intruder is made, and which pixels it can change.
struct CoarseGrid {
  int step_px = 1;
  cv::Rect rect;    // pixel (i, j) covers the square [i, i + 1) x [j, j + 1) times step_px, from the image's corner
  cv::Rect target;  // pixels within the image that its light can reach
};

// The coarse pixels that hold what blur carries into the image. Nothing where it carries nothing there.
//   box       the silhouette, where it bounds the intruder; none: it can be anywhere
//   sigma_px  above kCoarseBlurSigma_px
// What lies more than 16 focal lengths beyond the image's edges is left out: through a pinhole, 86 degrees off axis.
[[nodiscard]] std::optional<CoarseGrid> coarse_grid(const std::optional<Box>& box, const Camera& camera,
                                                    const cv::Rect& image, double sigma_px);

// The views to draw for the grid's coarse pixels.
//   lens  of the coarse camera with a pixel for each coarse pixel
[[nodiscard]] std::vector<VirtualCamera> coarse_views(const CoarseGrid& grid, LensTable& lens, const RenderItem& item,
                                                      double supersampling, int max_size_px);

// The blurred layer over the grid's target; empty where it is too faint to change any 8-bit sample.
//   sharp  the part within the image, whose coverage is taken over
//   views  for the grid's coarse pixels; none: `sharp` is the whole intruder and the coarse pixels are made of its
//   pixels lens   of the coarse camera min_light  what changes no sample of the footage (video/transfer_function.h)
[[nodiscard]] Layer coarse_blurred(const CoarseGrid& grid, const Layer& sharp, std::span<const RenderedView> views,
                                   LensTable& lens, double sigma_px, double min_light);

}  // namespace sigs
