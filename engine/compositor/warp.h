// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

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
// (AreaReader). Pixels that have no ray stay empty. Several views (the faces of a cube around the camera)
// must not overlap in direction; each pixel asks the one whose axis its upper left ray is nearest to. Energy is kept:
// the sum over pixels is the sum over the view, times the ratio of their pixel areas.
//   row_transform  of a rolling shutter: where the rays of a row lead in the views; null: as they are. Rows count in
//                pixels of target, so the upper edge of row y is y - 0.5
[[nodiscard]] Layer warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
                           const RowTransform& row_transform = nullptr);

// The same through a table that is made for this one layer.
[[nodiscard]] Layer warped(std::span<const RenderedView> views, const Camera& camera, const cv::Rect& target);

// A layer at full, half, quarter ... size: each texel is the mean of four below it, what lies outside counts as empty,
// so every level holds the same energy. Texel (i, j) of level n covers the square [i, i + 1) x [j, j + 1) times 2^n of
// the layer's pixels, measured from its upper left corner. The last level is a single texel. Levels are made where they
// are asked for.
class LayerPyramid {
 public:
  explicit LayerPyramid(const Layer& layer);  // not empty; shares its samples

  struct Level {
    cv::Mat color;                 // CV_32FC4
    cv::Mat coverage;              // CV_32FC1
    std::vector<cv::Range> spans;  // of each row: the columns outside which all texels are empty
    cv::Rect occupied;             // around all of them; empty where every texel is
  };
  [[nodiscard]] const Level& level(int n);
  [[nodiscard]] int level_count() const { return level_count_; }

 private:
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

  // Empty where the quadrilateral has no area, misses the layer or has a corner that is not finite.
  [[nodiscard]] AreaMean mean_over(const Quadrilateral& corners);

 private:
  struct Edge {
    glm::dvec2 from, to;
    double slope = 0;  // dx / dy
  };
  void find_row_areas(const std::array<Edge, 4>& edges, double top, int first, int end);
  [[nodiscard]] AreaMean mean_over_texels(const LayerPyramid::Level& level, const Quadrilateral& corners);

  LayerPyramid pyramid_;
  std::vector<double> lefts_;  // area left of each grid line of one row of texels
};

}  // namespace sigs
