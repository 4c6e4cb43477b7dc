// SPDX-License-Identifier: MIT
#include "compositor/synthetic_layers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace sigs::test {

Layer even_layer(const cv::Rect& rect, const cv::Vec4f& color) {
  return {rect, cv::Mat(rect.size(), CV_32FC4, cv::Scalar(color[0], color[1], color[2], color[3])),
          cv::Mat(rect.size(), CV_32FC1, cv::Scalar(1))};
}

Layer cloudy_layer(const cv::Rect& rect, unsigned seed) {
  cv::RNG random(seed);
  Layer layer = even_layer(rect, {0, 0, 0, 0});
  layer.coverage.setTo(0);
  for (int blob = 0; blob < 6; ++blob) {
    const double x = rect.width * random.uniform(0.3, 0.7);
    const double y = rect.height * random.uniform(0.3, 0.7);
    const double reach = 0.25 * std::min(rect.width, rect.height) * random.uniform(0.4, 1.0);
    const cv::Vec3f color(random.uniform(0.0F, 1.0F), random.uniform(0.0F, 1.0F), random.uniform(0.0F, 1.0F));
    for (int j = 0; j < rect.height; ++j)
      for (int i = 0; i < rect.width; ++i) {
        const double r = std::hypot(i - x, j - y) / reach;
        if (r >= 1) continue;
        const auto opacity = static_cast<float>(0.9 * std::pow(std::cos(r * CV_PI / 2), 2));
        cv::Vec4f& below = layer.color.at<cv::Vec4f>(j, i);
        below = cv::Vec4f(color[0], color[1], color[2], 1) * opacity + below * (1 - opacity);
        layer.coverage.at<float>(j, i) = std::max(layer.coverage.at<float>(j, i), opacity);
      }
  }
  return layer;
}

RenderedView view_ahead(Layer layer, double focal_px, const glm::dvec2& center_px) {
  RenderedView drawn;
  drawn.view.focal_px = focal_px;
  drawn.view.center_px = center_px;
  drawn.view.size_px = layer.rect.size();
  drawn.layer = std::move(layer);
  return drawn;
}

Lens lens_of(LensModel model, double focal_px, const glm::dvec2& center_px, const std::vector<double>& coefficients) {
  Result<Lens> lens = Lens::make({model, focal_px, focal_px * 1.01, center_px.x, center_px.y, coefficients});
  if (!lens) FAIL(lens.error().text());
  return *lens;
}

std::vector<NamedCamera> distorting_cameras(cv::Size size_px) {
  const double focal_px = 0.8 * size_px.width;
  const glm::dvec2 center_px(size_px.width / 2.0 + 2.3, size_px.height / 2.0 - 3.7);
  const LensModel brown = LensModel::brown_conrady;
  return {
      {"Brown-Conrady 5", {lens_of(brown, focal_px, center_px, {-0.18, 0.05, 0.001, -0.0015, -0.004}), size_px}},
      {"Brown-Conrady 8",
       {lens_of(brown, focal_px, center_px, {0.4, 0.12, -0.0008, 0.0006, 0.01, 0.62, 0.2, 0.02}), size_px}},
      {"fisheye", {lens_of(LensModel::kannala_brandt, 0.7 * focal_px, center_px, {0.04, 0.01, -0.01, 0.002}), size_px}},
      {"omnidirectional",
       {lens_of(LensModel::omnidirectional, 1.6 * focal_px, center_px, {0.9, -0.02, 0.01, 0.0005, -0.0004, 0.001}),
        size_px}}};
}

bool is_valid(const Layer& layer) {
  for (int y = 0; y < layer.rect.height; ++y)
    for (int x = 0; x < layer.rect.width; ++x) {
      const cv::Vec4f& color = layer.color.at<cv::Vec4f>(y, x);
      for (int c = 0; c < 4; ++c)
        if (!std::isfinite(color[c]) || color[c] < 0) return false;
      const float coverage = layer.coverage.at<float>(y, x);
      // Sums of some hundred floats round in the last of 24 bits.
      if (!(color[3] <= 1 + 1e-5F && coverage >= 0 && coverage <= 1 + 1e-5F)) return false;
    }
  return true;
}

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (std::memcmp(a.ptr(y), b.ptr(y), static_cast<std::size_t>(a.cols) * a.elemSize()) != 0) return false;
  return true;
}

}  // namespace sigs::test
