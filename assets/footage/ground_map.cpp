// SPDX-License-Identifier: MIT
#include "ground_map.h"

#include <algorithm>
#include <cmath>

#include "parallel.h"

namespace sigs::footage {

namespace {

constexpr double kMinExtent_m = 420;
constexpr float kUnit = 65535.0F / 2;

GroundMap::Layer empty_layer(int k, double flight_m) {
  const double cell_m = GroundMap::kFinestCell_m * (1 << k), reach_m = kMinExtent_m * (1 << k);
  const int rows = static_cast<int>((flight_m + reach_m) / cell_m) + 4,
            columns = static_cast<int>(2 * reach_m / cell_m) + 4;
  return {cell_m, {-2 * cell_m, -0.5 * cell_m * columns}, cv::Mat_<cv::Vec3w>(rows, columns)};
}

}  // namespace

GroundMap::GroundMap(double flight_m, const PaintRow& paint, const Finish& finish) {
  for (int k = 0; k < kLayers; ++k) {
    Layer layer = empty_layer(k, flight_m);
    cv::Mat color(layer.color.size(), CV_32FC3);
    parallel_rows(color.rows, [&](int row) {
      const std::vector<glm::vec3> painted = paint(layer, row);
      for (int i = 0; i < color.cols; ++i) color.at<cv::Vec3f>(row, i) = {painted[i].r, painted[i].g, painted[i].b};
    });
    finish(layer, color);
    color.convertTo(layer.color, CV_16UC3, kUnit);
    layers_.push_back(std::move(layer));
  }
}

glm::vec3 GroundMap::at(const Layer& layer, const glm::dvec2& p_m) const {
  const glm::dvec2 cell = (p_m - layer.origin_m) / layer.cell_m;
  const double row = std::clamp(cell.x, 0.0, layer.color.rows - 1.001);
  const double column = std::clamp(cell.y, 0.0, layer.color.cols - 1.001);
  const int r = static_cast<int>(row), c = static_cast<int>(column);
  const float u = static_cast<float>(column - c), v = static_cast<float>(row - r);
  const cv::Vec3w* upper = layer.color[r] + c;
  const cv::Vec3w* lower = layer.color[r + 1] + c;
  glm::vec3 sum;
  for (int k = 0; k < 3; ++k) {
    const float a = upper[0][k] + u * static_cast<float>(upper[1][k] - upper[0][k]);
    const float b = lower[0][k] + u * static_cast<float>(lower[1][k] - lower[0][k]);
    sum[k] = a + v * (b - a);
  }
  return sum / kUnit;
}

glm::vec3 GroundMap::between_layers(const glm::dvec2& p_m, double level) const {
  const double clamped = std::clamp(level, 0.0, kLayers - 1.001);
  const int k = static_cast<int>(clamped);
  return glm::mix(at(layers_[k], p_m), at(layers_[k + 1], p_m), static_cast<float>(clamped - k));
}

glm::vec3 GroundMap::mean(const glm::dvec2& p_m, const glm::dvec2& step_right_m, const glm::dvec2& step_down_m) const {
  const bool right_longer = glm::length(step_right_m) > glm::length(step_down_m);
  const glm::dvec2 longer = right_longer ? step_right_m : step_down_m;
  const double length_m = glm::length(longer);
  const double area_m2 = std::abs(step_right_m.x * step_down_m.y - step_right_m.y * step_down_m.x);
  const double width_m = std::max(area_m2 / length_m, length_m / 16);
  const int taps = std::clamp(static_cast<int>(std::ceil(length_m / width_m)), 1, 16);
  // The finer of the two layers that are mixed must extend as far as p.
  const double reach = std::max({std::abs(p_m.y), p_m.x, 1.0}) / kMinExtent_m;
  const double level = std::max(std::log2(width_m / kFinestCell_m), std::log2(reach) + 1);
  glm::vec3 sum{0};
  for (int i = 0; i < taps; ++i) sum += between_layers(p_m + longer * ((i + 0.5) / taps - 0.5), level);
  return sum / static_cast<float>(taps);
}

}  // namespace sigs::footage
