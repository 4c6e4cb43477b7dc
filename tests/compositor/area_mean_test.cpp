// SPDX-License-Identifier: MIT
#include "compositor/warp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "compositor/synthetic_layers.h"

namespace sigs::test {
namespace {

// Area that a polygon has in common with one texel: the polygon cut by the texel's four sides, one after the other.
double common_area(const Quadrilateral& corners, int i, int j) {
  std::vector<glm::dvec2> polygon(corners.begin(), corners.end());
  const auto cut = [&polygon](const glm::dvec2& inward, double offset) {
    std::vector<glm::dvec2> kept;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
      const glm::dvec2 a = polygon[n];
      const glm::dvec2 b = polygon[(n + 1) % polygon.size()];
      const double da = glm::dot(a, inward) - offset;
      const double db = glm::dot(b, inward) - offset;
      if (da >= 0) kept.push_back(a);
      if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    polygon = kept;
  };
  cut({1, 0}, i);
  cut({-1, 0}, -(i + 1.0));
  cut({0, 1}, j);
  cut({0, -1}, -(j + 1.0));
  double doubled = 0;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2 a = polygon[n];
    const glm::dvec2 b = polygon[(n + 1) % polygon.size()];
    doubled += a.x * b.y - a.y * b.x;
  }
  return std::abs(doubled) / 2;
}

double brute_mean(const cv::Mat& coverage, const Quadrilateral& corners) {
  double sum = 0;
  double area = 0;
  for (int j = -12; j < coverage.rows + 12; ++j)
    for (int i = -12; i < coverage.cols + 12; ++i) {
      const double share = common_area(corners, i, j);
      area += share;
      if (i >= 0 && j >= 0 && i < coverage.cols && j < coverage.rows) sum += share * coverage.at<float>(j, i);
    }
  return sum / area;
}

Layer noise(const cv::Size& size, unsigned seed) {
  Layer layer = even_layer({{0, 0}, size}, {0, 0, 0, 0});
  cv::RNG random(seed);
  random.fill(layer.coverage, cv::RNG::UNIFORM, 0.0, 1.0);
  random.fill(layer.color, cv::RNG::UNIFORM, 0.0, 1.0);
  return layer;
}

}  // namespace

TEST_CASE("the mean over a quadrilateral weighs texels by the area they share with it") {
  const Layer layer = noise({14, 11}, 4);
  AreaReader reader(layer);
  cv::RNG random(9);
  const auto wobble = [&random](double by) { return glm::dvec2(random.uniform(-by, by), random.uniform(-by, by)); };
  for (int n = 0; n < 300; ++n) {
    const glm::dvec2 middle(random.uniform(-2.0, 16.0), random.uniform(-2.0, 13.0));
    const double angle_rad = random.uniform(-4.0, 4.0);
    const double half = random.uniform(0.75, 3.4);
    const glm::dvec2 right(half * std::cos(angle_rad), half * std::sin(angle_rad));
    const glm::dvec2 down(-right.y, right.x);
    const Quadrilateral corners{middle - right - down + wobble(0.1), middle + right - down + wobble(0.1),
                                middle + right + down + wobble(0.1), middle - right + down + wobble(0.1)};
    const double wanted = brute_mean(layer.coverage, corners);
    CHECK(reader.mean_over(corners).coverage == doctest::Approx(wanted).epsilon(1e-5));  // sums of floats
    const Quadrilateral other_way{corners[0], corners[3], corners[2], corners[1]};
    CHECK(reader.mean_over(other_way).coverage == doctest::Approx(wanted).epsilon(1e-5));
  }
}

TEST_CASE("quadrilaterals that tile a layer divide all of its energy, thin ones and slanted ones too") {
  const Layer layer = noise({40, 30}, 5);
  for (const double step : {1.0, 1.37, 2.0, 5.2, 11.0, 37.0, 400.0}) {
    CAPTURE(step);
    AreaReader reader(layer);
    const auto corner = [step](int i, int j) {
      return glm::dvec2(step * (i + 0.13 * std::sin(j)) - 1.7, step * (j + 0.11 * std::sin(2.0 * i)) - 2.9);
    };
    double energy = 0;
    const int count = static_cast<int>(45 / step) + 4;
    for (int j = -2; j < count; ++j)
      for (int i = -2; i < count; ++i) {
        const Quadrilateral q{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
        const glm::dvec2 a = q[2] - q[0];
        const glm::dvec2 b = q[3] - q[1];
        energy += std::abs(a.x * b.y - a.y * b.x) / 2 * reader.mean_over(q).color[1];
      }
    // Below one texel a side is widened to one, which gives tent weights.
    CHECK(energy == doctest::Approx(cv::sum(layer.color)[1]).epsilon(step > 1.2 ? 1e-5 : 0.02));
  }
}

TEST_CASE("a level knows between which columns of each row there is anything, in any of the colours or in coverage") {
  const auto wanted_span = [](const Layer& layer, int row) {
    int first = layer.color.cols;
    int end = 0;
    for (int i = 0; i < layer.color.cols; ++i) {
      const bool occupied =
          layer.color.at<cv::Vec4f>(row, i) != cv::Vec4f(0, 0, 0, 0) || layer.coverage.at<float>(row, i) != 0;
      if (occupied) first = std::min(first, i), end = i + 1;
    }
    return cv::Range(first, std::max(first, end));
  };
  cv::RNG random(3);
  for (const int width : {1, 7, 16, 33, 70}) {
    Layer layer = even_layer(cv::Rect(0, 0, width, 60), {0, 0, 0, 0});
    layer.coverage.setTo(0);
    for (int row = 1; row < 60; ++row)  // the first row is empty
      for (int n = 0; n < row % 4; ++n) {
        const int channel = random.uniform(0, 5);
        const int column = random.uniform(0, width);
        if (channel < 4) layer.color.at<cv::Vec4f>(row, column)[channel] = 1e-30F;
        if (channel == 4) layer.coverage.at<float>(row, column) = 1;
      }
    LayerPyramid pyramid(layer);
    for (int row = 0; row < 60; ++row) {
      const cv::Range wanted = wanted_span(layer, row);
      const cv::Range& span = pyramid.level(0).spans[static_cast<std::size_t>(row)];
      CHECK(span.size() == wanted.size());
      if (wanted.size() > 0) CHECK(span == wanted);
    }
  }
}

TEST_CASE("a quadrilateral without area, without a place or beside the layer has an empty mean") {
  const Layer layer = noise({8, 8}, 6);
  AreaReader reader(layer);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const glm::dvec2 middle(4, 4);
  CHECK(reader.mean_over({middle, middle, middle, middle}).coverage == 0);
  CHECK(reader.mean_over({glm::dvec2(1, 1), {3, 3}, {5, 5}, {2, 2}}).coverage == 0);
  for (const double odd : {kNan, kInfinity, -kInfinity, 1e300})
    CHECK(reader.mean_over({glm::dvec2(odd, 1), {3, 1}, {3, 3}, {odd, 3}}).coverage == 0);
  CHECK(reader.mean_over({glm::dvec2(20, 1), {22, 1}, {22, 3}, {20, 3}}).coverage == 0);
  CHECK(reader.mean_over({glm::dvec2(-1e9, 1), {-1e8, 1}, {-1e8, 3}, {-1e9, 3}}).coverage == 0);
  CHECK(reader.mean_over({glm::dvec2(2, 2), {4, 2}, {4, 4}, {2, 4}}).coverage ==
        doctest::Approx(cv::mean(layer.coverage({2, 2, 2, 2}))[0]));
}

TEST_CASE("an empty layer has empty means and a single texel is found") {
  Layer layer = even_layer({0, 0, 33, 21}, {0, 0, 0, 0});
  layer.coverage.setTo(0);
  AreaReader nothing(layer);
  CHECK(nothing.mean_over({glm::dvec2(0, 0), {33, 0}, {33, 21}, {0, 21}}).coverage == 0);
  layer.color.at<cv::Vec4f>(20, 32) = {0, 0, 0.5F, 0};  // light without opacity
  AreaReader one(layer);
  CHECK(one.mean_over({glm::dvec2(31, 19), {33, 19}, {33, 21}, {31, 21}}).color[2] == doctest::Approx(0.125));
  // Texels of a coarser level extend beyond the layer; so does the quadrilateral.
  CHECK(one.mean_over({glm::dvec2(-2, -2), {38, -2}, {38, 26}, {-2, 26}}).color[2] == doctest::Approx(0.5 / (40 * 28)));
}

}  // namespace sigs::test
