// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "base/image.h"
#include "compositor/area_reader.h"

namespace sigs {

// A view drawn with fewer pixels, each for a cell of step by step pixels of the fine one, of which only those cells are
// then drawn that the coarse pixels do not tell.
struct CoarseView {
  Layer layer;       // from the fine view's upper left corner on; its last cells may extend beyond the fine view
  cv::Mat is_rough;  // CV_8UC1 of its size; not 0: this cell has to be drawn
  int step = 1;
};

// Pixels of a layer at which it bends, horizontally or vertically, by more than max_bend_codes code values of 8 bits:
// at an edge or in detail, so that finer pixels could not be interpolated from it. Where coverage changes, too. The
// bend is the second difference, of colours and of opacity, over what a square root makes of linear light, which is
// nearly sRGB. CV_8UC1, 255 or 0.
[[nodiscard]] cv::Mat bent_pixels(const Layer& layer, double max_bend_codes);

// The cells that a quadrilateral of the fine view touches, clipped to the view.
[[nodiscard]] cv::Rect cells_touched(const CoarseView& view, const Quadrilateral& corners);

[[nodiscard]] bool is_rough_in(const CoarseView& view, const cv::Rect& cells);

// The mean over a quadrilateral that touches no rough cell: the layer at its middle, interpolated.
[[nodiscard]] AreaMean interpolated(const CoarseView& view, const Quadrilateral& corners);

}  // namespace sigs
