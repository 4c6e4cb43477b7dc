// SPDX-License-Identifier: MIT
#include "attitude_flights/tile.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "attitude_flights/random.h"

namespace sigs::made {

namespace {

cv::Mat_<float> halved(const cv::Mat_<float>& image) {
  cv::Mat_<float> half(image.rows / 2, image.cols / 2);
  for (int y = 0; y < half.rows; ++y)
    for (int x = 0; x < half.cols; ++x)
      half(y, x) =
          (image(2 * y, 2 * x) + image(2 * y, 2 * x + 1) + image(2 * y + 1, 2 * x) + image(2 * y + 1, 2 * x + 1)) / 4;
  return half;
}

// Weights of the uniform cubic B-spline at u in 0..1.
std::array<float, 4> spline_weights(float u) {
  const float v = 1 - u;
  return {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6, u * u * u / 6};
}

void add_octave(cv::Mat_<float>& sum, int distance, float strength, std::uint32_t seed) {
  const int rows = std::max(1, sum.rows / distance), columns = std::max(1, sum.cols / distance);
  cv::Mat_<float> points(rows, columns);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) points(j, i) = static_cast<float>(even(i, j, seed) * 2 - 1) * strength;
  struct Column {
    std::array<float, 4> weights;
    std::array<int, 4> points;
  };
  std::vector<Column> across;
  for (int x = 0; x < sum.cols; ++x) {
    across.push_back({spline_weights(static_cast<float>(x % distance) / static_cast<float>(distance)), {}});
    for (int k = 0; k < 4; ++k) across.back().points[k] = (x / distance + k - 1 + columns) % columns;
  }
  for (int y = 0; y < sum.rows; ++y) {
    const auto wy = spline_weights(static_cast<float>(y % distance) / static_cast<float>(distance));
    cv::Mat_<float> row(1, columns, 0.0F);
    for (int k = 0; k < 4; ++k) row += static_cast<double>(wy[k]) * points.row((y / distance + k - 1 + rows) % rows);
    for (int x = 0; x < sum.cols; ++x)
      for (int k = 0; k < 4; ++k) sum(y, x) += across[x].weights[k] * row(0, across[x].points[k]);
  }
}

}  // namespace

Tile::Tile(cv::Mat_<float> finest, double cell) : cell_(cell) {
  levels_.push_back(std::move(finest));
  while (levels_.back().rows > 1 && levels_.back().cols > 1) levels_.push_back(halved(levels_.back()));
}

float Tile::linear(int level, const glm::dvec2& p) const {
  const cv::Mat_<float>& image = levels_[level];
  // The centre of the first cell of level 0 is at 0; those of a level above lie between those of the one below.
  const double scale = 1.0 / (cell_ * (1 << level)), shift = 0.5 / (1 << level) - 0.5;
  const double x = p.x * scale + shift, y = p.y * scale + shift;
  const double fx = std::floor(x), fy = std::floor(y);
  const auto u = static_cast<float>(x - fx), v = static_cast<float>(y - fy);
  const int x0 = static_cast<int>(fx) & (image.cols - 1), x1 = (x0 + 1) & (image.cols - 1);
  const int y0 = static_cast<int>(fy) & (image.rows - 1), y1 = (y0 + 1) & (image.rows - 1);
  const float *upper = image[y0], *lower = image[y1];
  const float a = upper[x0] + u * (upper[x1] - upper[x0]), b = lower[x0] + u * (lower[x1] - lower[x0]);
  return a + v * (b - a);
}

float Tile::mean(const glm::dvec2& p, double diameter) const {
  const double last = static_cast<double>(levels_.size()) - 1.001;
  const double level = std::clamp(std::log2(diameter / cell_), 0.0, last);
  const int k = static_cast<int>(level);
  const auto share = static_cast<float>(level - k);
  return (1 - share) * linear(k, p) + share * linear(k + 1, p);
}

float Tile::value_of_share(double share) const {
  std::vector<float> values(levels_[0].begin(), levels_[0].end());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

cv::Mat_<float> repeating_noise(const NoiseSettings& settings) {
  cv::Mat_<float> sum(settings.size_px, 0.0F);
  double strength = 1;
  for (int distance = settings.coarsest, i = 0; distance >= settings.finest; distance /= 2, ++i) {
    add_octave(sum, distance, static_cast<float>(strength), scrambled(i, 31, settings.seed));
    strength *= settings.fall;
  }
  cv::Scalar mean, deviation;
  cv::meanStdDev(sum, mean, deviation);
  return cv::Mat_<float>(cv::Mat((sum - mean[0]) / deviation[0]));
}

cv::Mat_<float> repeating_patches(cv::Size size_px, int patch, std::uint32_t seed) {
  const int rows = size_px.height / patch, columns = size_px.width / patch;
  struct Point {
    double x, y;  // in its cell, 0..1
    float value;
  };
  std::vector<Point> points;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      points.push_back({even(i, j, seed), even(i, j, seed + 1), static_cast<float>(even(i, j, seed + 2) * 2 - 1)});
  const auto value = [&](int y, int x) {
    double nearest = 1e30;
    float found = 0;
    for (int j = y / patch - 1; j <= y / patch + 1; ++j)
      for (int i = x / patch - 1; i <= x / patch + 1; ++i) {
        const Point& point = points[(j + rows) % rows * columns + (i + columns) % columns];
        const double dx = (i + point.x) * patch - x, dy = (j + point.y) * patch - y;
        if (const double square = dx * dx + dy * dy; square < nearest) {
          nearest = square;
          found = point.value;
        }
      }
    return found;
  };
  cv::Mat_<float> patches(size_px);
  for (int y = 0; y < patches.rows; ++y)
    for (int x = 0; x < patches.cols; ++x) patches(y, x) = value(y, x);
  return patches;
}

}  // namespace sigs::made
