// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "base/image.h"

namespace sigs {

// A layer at full, half, quarter ... size: each texel is the mean of four below it, what lies outside counts as empty,
// so every level holds the same energy. Texel (i, j) of level n covers the square [i, i + 1) x [j, j + 1) times 2^n of
// the layer's pixels, measured from its upper left corner. The last level is a single texel. Levels are made where they
// are asked for.
class LayerPyramid {
 public:
  explicit LayerPyramid(const Layer& layer);  // not empty; shares its samples

  // Of a layer of which only some parts are defined. It has one level, and takes all of it as occupied.
  [[nodiscard]] static LayerPyramid of_parts(const Layer& layer);

  struct Level {
    cv::Mat color;                 // CV_32FC4
    cv::Mat coverage;              // CV_32FC1
    std::vector<cv::Range> spans;  // of each row: the columns outside which all texels are empty
    cv::Rect occupied;             // around all of them; empty where every texel is
  };
  [[nodiscard]] const Level& level(int n);
  [[nodiscard]] int level_count() const { return level_count_; }

 private:
  LayerPyramid() = default;

  std::vector<Level> levels_;  // those made so far
  int level_count_ = 1;
};

// A convex quadrilateral, its corners in order round it; pixels of a layer, measured from its upper left corner.
using Quadrilateral = std::array<glm::dvec2, 4>;

struct AreaMean {
  cv::Vec4f color{0, 0, 0, 0};
  float coverage = 0;
};

// Means of a layer over quadrilaterals: each texel counts with the area that it has in common with the quadrilateral,
// exactly. So quadrilaterals that tile a part of the layer divide all of its energy, whatever their sizes are.
//
// Where the shorter side spans more than 16 texels, or the longer one more than 64, the texels are those of a coarser
// level of the layer's pyramid. One that spans less than a texel is widened to one about its middle, which reads the
// layer bilinearly, so that the texels of a coarse layer do not show as squares.
class AreaReader {
 public:
  explicit AreaReader(const Layer& layer) : pyramid_(layer) {}
  explicit AreaReader(LayerPyramid pyramid) : pyramid_(std::move(pyramid)) {}

  // Empty where the quadrilateral has no area, misses the layer or has a corner that is not finite.
  [[nodiscard]] AreaMean mean_over(const Quadrilateral& corners);

 private:
  [[nodiscard]] AreaMean mean_in(int level, const Quadrilateral& corners);  // clockwise, in texels of the level

  LayerPyramid pyramid_;
  std::vector<double> lefts_;  // area left of each grid line of one row of texels
};

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
