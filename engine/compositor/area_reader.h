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

}  // namespace sigs
