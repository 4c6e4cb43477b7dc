// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "base/layer.h"

namespace sigs {

// A layer at full, half, quarter ... size: each texel is the mean of four below it, what lies outside counts as empty,
// so every level holds the same energy. Texel (i, j) of level n covers the square [i, i + 1) x [j, j + 1) times 2^n of
// the layer's pixels, measured from its upper left corner. The last level is a single texel.
class LayerPyramid {
 public:
  explicit LayerPyramid(const Layer& layer);

  struct Level {
    cv::Mat color;     // CV_32FC4
    cv::Mat coverage;  // CV_32FC1
  };
  [[nodiscard]] const Level& level(int n) const { return levels_[static_cast<std::size_t>(n)]; }
  [[nodiscard]] int level_count() const { return static_cast<int>(levels_.size()); }

 private:
  std::vector<Level> levels_;
};

}  // namespace sigs
