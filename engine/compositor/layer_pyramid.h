// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "base/layer.h"

namespace sigs {

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

}  // namespace sigs
