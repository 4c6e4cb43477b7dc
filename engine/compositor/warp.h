// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "base/image.h"
#include "camera/camera.h"
#include "camera/lens_table.h"
#include "camera/row_motion.h"
#include "camera/virtual_camera.h"

namespace sigs {

// An intruder as one virtual view shows it; the layer covers the whole view.
struct RenderedView {
  VirtualCamera view;
  Layer layer;
};

// The intruder as the camera sees it, over the pixels of target (which may extend beyond the image): each pixel asks
// the lens for the rays of its four corners and takes the mean of what the view shows between them, by area
// (compositor/area_mean.h). Pixels that have no ray stay empty. Several views (the faces of a cube around the camera)
// must not overlap in direction; each pixel asks the one whose axis its upper left ray is nearest to. Energy is kept:
// the sum over pixels is the sum over the view, times the ratio of their pixel areas.
//   turn_of_row  of a rolling shutter: where the rays of a row lead in the views; null: as they are. Rows count in
//                pixels of target, so the upper edge of row y is y - 0.5
[[nodiscard]] Layer warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
                           const TurnOfRow& turn_of_row = nullptr);

// The same through a table that is made for this one layer.
[[nodiscard]] Layer warped(std::span<const RenderedView> views, const Camera& camera, const cv::Rect& target);

}  // namespace sigs
