// SPDX-License-Identifier: MIT
#include "reference/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/ensure.h"
#include "reference/gaussian_weights.h"
#include "reference/ray_tracer.h"
#include "reference/sample_accumulation.h"
#include "reference/transfer.h"

namespace sigs::truth {
namespace {

constexpr int kRaysAcross = 256;  // at least, over the larger side of what is seen

// Part of the plane of pixels, edges included.
struct Window {
  glm::dvec2 low_px;
  glm::dvec2 high_px;

  [[nodiscard]] bool is_empty() const { return !(low_px.x < high_px.x && low_px.y < high_px.y); }
};

Window common(const Window& a, const Window& b) {
  return {glm::max(a.low_px, b.low_px), glm::min(a.high_px, b.high_px)};
}

// The region from which blur may bring light into the image.
Window window_of(const Setup& setup) {
  const double reach_px = std::ceil(kReachOfBlur * setup.sigma_px);
  return {glm::dvec2(-0.5 - reach_px), glm::dvec2(setup.size_px.width, setup.size_px.height) - 0.5 + reach_px};
}

FineGrid grid_over(const Window& window, int per_px, int period) {
  FineGrid grid{.per_px = per_px, .period = period, .stride = stride_for(period)};
  grid.first_x = static_cast<std::int64_t>(std::floor((window.low_px.x + 0.5) * per_px));
  grid.first_y = static_cast<std::int64_t>(std::floor((window.low_px.y + 0.5) * per_px));
  grid.count_x = static_cast<int>(std::ceil((window.high_px.x + 0.5) * per_px) - double(grid.first_x));
  grid.count_y = static_cast<int>(std::ceil((window.high_px.y + 0.5) * per_px) - double(grid.first_y));
  return grid;
}

// A pass with one ray a pixel, where edges alone do not bound the body.
Window looked_for(const RayTracer& tracer, const Outline& outline, const Window& window) {
  constexpr double kMargin_px = 8;
  const FineGrid grid = grid_over(window, 1, 1);
  Outline found = outline;
  for (int j = 0; j < grid.count_y; ++j) {
    const std::vector<RayHit> row = tracer.row(grid, j);
    for (int i = 0; i < grid.count_x; ++i)
      if (row[static_cast<std::size_t>(i)].hits) found.add(grid.ray_px(i, j));
  }
  if (found.is_empty) return {};
  return common({found.low_px - kMargin_px, found.high_px + kMargin_px}, window);
}

// Margin for edges that bow out between the places where they were followed.
Window window_around(const Outline& outline, const Window& window) {
  if (outline.is_empty) return {};
  const glm::dvec2 margin_px = glm::min(glm::dvec2(0.25), 0.01 * glm::length(outline.high_px - outline.low_px)) + 1e-9;
  return common({outline.low_px - margin_px, outline.high_px + margin_px}, window);
}

FineGrid grid_for(const RayTracer& tracer, const Setup& setup, const Settings& settings) {
  const Window all = window_of(setup);
  const Outline outline = tracer.outline();
  const Window window = outline.is_whole ? window_around(outline, all) : looked_for(tracer, outline, all);
  if (window.is_empty()) return {};
  const glm::dvec2 span_px = window.high_px - window.low_px;
  const double times = kRaysAcross / (std::max(span_px.x, span_px.y) * settings.samples_per_side);
  const int finer = static_cast<int>(std::clamp(std::ceil(times), 1.0, 1e8 / settings.samples_per_side));
  return grid_over(window, settings.samples_per_side * finer, settings.samples_per_side);
}

void take_off_own_body(cv::Mat& color, const cv::Rect& rect, const cv::Mat& own_body) {
  if (own_body.empty()) return;
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x)
      color.at<cv::Vec4d>(y, x) *= 1 - double{own_body.at<float>(rect.y + y, rect.x + x)};
}

}  // namespace

ReferenceImage reference_image(const Setup& setup, const Settings& settings) {
  ENSURE(setup.mesh != nullptr && settings.samples_per_side >= 1 && setup.sigma_px >= 0);
  if (setup.mesh->indices.empty() || setup.size_px.empty()) return {};
  const RayTracer tracer(setup);
  const FineGrid grid = grid_for(tracer, setup, settings);
  if (grid.count_x <= 0 || grid.count_y <= 0) return {};
  const cv::Rect image({0, 0}, setup.size_px);
  ReferenceImage truth = accumulated(tracer, grid, setup.sigma_px, image);
  take_off_own_body(truth.color, truth.rect, setup.own_body);
  return truth;
}

cv::Mat over_background(const ReferenceImage& truth, const cv::Mat& background_rgb) {
  ENSURE(background_rgb.type() == CV_8UC3);
  cv::Mat codes(truth.rect.size(), CV_64FC3);
  for (int y = 0; y < truth.rect.height; ++y)
    for (int x = 0; x < truth.rect.width; ++x) {
      const cv::Vec4d& color = truth.color.at<cv::Vec4d>(y, x);
      const cv::Vec3b& below = background_rgb.at<cv::Vec3b>(truth.rect.y + y, truth.rect.x + x);
      for (int c = 0; c < 3; ++c) {
        const double light = color[c] + (1 - color[3]) * light_of_code(below[c] / 255.0);
        codes.at<cv::Vec3d>(y, x)[c] = 255 * std::clamp(code_of_light(light), 0.0, 1.0);
      }
    }
  return codes;
}

}  // namespace sigs::truth
