// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "camera/camera.h"
#include "camera/lens_table.h"
#include "camera/row_motion.h"
#include "camera/virtual_camera.h"
#include "compositor/area_reader.h"

namespace sigs {

// An intruder as one virtual view shows it; the layer covers the whole view. With a coarse view it need only have the
// cells that cells_read() names.
struct RenderedView {
  VirtualCamera view;
  Layer layer;
  std::optional<CoarseView> coarse;
};

// The intruder as the camera sees it, over the pixels of target (which may extend beyond the image): each pixel asks
// the lens for the rays of its four corners and takes the mean of what the view shows between them, by area
// (AreaReader). Pixels that have no ray stay empty. Several views (the faces of a cube around the camera)
// must not overlap in direction; each pixel asks the one whose axis its upper left ray is nearest to. Energy is kept:
// the sum over pixels is the sum over the view, times the ratio of their pixel areas.
//   row_transform  of a rolling shutter: where the rays of a row lead in the views; null: as they are. Rows count in
//                pixels of target, so the upper edge of row y is y - 0.5
[[nodiscard]] Layer warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
                           const RowTransform& row_transform = nullptr);

// The same with steps by steps samples for each pixel, evenly spread over it: sample (i, j) covers the square
// [i, i + 1) x [j, j + 1) of steps of a pixel, from the corner of pixel (0, 0) on. Within a pixel the lens is taken to
// be bilinear. For what is blurred before pixels average it; see averaged().
[[nodiscard]] Layer finely_warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
                                  int steps, const RowTransform& row_transform = nullptr);

// A layer of steps by steps samples for each pixel as pixels: the means over them. Its samples begin and end anywhere;
// beyond them is nothing.
[[nodiscard]] Layer averaged(const Layer& fine, int steps);

// The cells of each view that warped() reads in its fine layer, which need not be there yet: those that a pixel of the
// target touches together with a rough one. All views have coarse ones. CV_8UC1, 255 or 0. None where pixels are so
// large in a view that areas have to be summed.
[[nodiscard]] std::optional<std::vector<cv::Mat>> cells_read(std::span<const RenderedView> views, LensTable& lens,
                                                             const cv::Rect& target,
                                                             const RowTransform& row_transform = nullptr);

// The same through a table that is made for this one layer.
[[nodiscard]] Layer warped(std::span<const RenderedView> views, const Camera& camera, const cv::Rect& target);

}  // namespace sigs
