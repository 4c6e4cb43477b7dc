// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::footage {

// The level ground, painted once in nested squares: each layer has cells twice as wide as the one before and extends
// twice as far. A pixel is then the mean over its own footprint, so nothing flickers however flat the view.
class GroundMap {
 public:
  static constexpr double kFinestCell_m = 0.35;
  static constexpr int kLayers = 9;

  struct Layer {
    double cell_m = 1;
    glm::dvec2 origin_m{0};     // world X, Y of the centre of the first cell; rows run along X, columns along Y
    cv::Mat_<cv::Vec3w> color;  // linear light, 65535 is 2.0
  };

  // paint(layer, row) gives a row of colours; finish(layer, colours) may draw on top, colours being CV_32FC3.
  using PaintRow = std::function<std::vector<glm::vec3>(const Layer&, int row)>;
  using Finish = std::function<void(const Layer&, cv::Mat& color)>;
  // flight_m: how far the camera travels along X from 0.
  GroundMap(double flight_m, const PaintRow& paint, const Finish& finish);

  // Mean colour over the parallelogram at p_m spanned by the steps to the next pixels.
  [[nodiscard]] glm::vec3 mean(const glm::dvec2& p_m, const glm::dvec2& step_right_m,
                               const glm::dvec2& step_down_m) const;

 private:
  [[nodiscard]] glm::vec3 between_layers(const glm::dvec2& p_m, double level) const;
  [[nodiscard]] glm::vec3 at(const Layer& layer, const glm::dvec2& p_m) const;
  std::vector<Layer> layers_;
};

}  // namespace sigs::footage
