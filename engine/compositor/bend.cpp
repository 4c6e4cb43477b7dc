// SPDX-License-Identifier: MIT
#include "compositor/bend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/ensure.h"
#include "compositor/layer_pyramid.h"

namespace sigs {

namespace {

using Ray = std::optional<glm::dvec3>;
using Corners = std::array<glm::dvec2, 4>;  // upper left, upper right, lower left, lower right; view pixels

struct Sample {
  cv::Vec4f color{0, 0, 0, 0};
  float coverage = 0;
};

struct Source {
  const VirtualView* view;
  LayerPyramid pyramid;
};

// Rays of the corners of target's pixels, row by row: (width + 1) x (height + 1).
std::vector<Ray> corner_rays(const Camera& camera, const cv::Rect& target) {
  std::vector<Ray> rays;
  rays.reserve(static_cast<std::size_t>(target.width + 1) * static_cast<std::size_t>(target.height + 1));
  for (int j = 0; j <= target.height; ++j)
    for (int i = 0; i <= target.width; ++i)
      rays.push_back(camera.lens.ray({target.x + i - 0.5, target.y + j - 0.5}));
  return rays;
}

// The view that looks most nearly along the ray.
const Source& nearest_source(std::span<const Source> sources, const glm::dvec3& ray) {
  const auto along_axis = [&ray](const Source& source) {
    return (source.view->view_from_camera.rotation * ray).x;
  };
  return *std::max_element(sources.begin(), sources.end(),
                           [&](const Source& a, const Source& b) { return along_axis(a) < along_axis(b); });
}

std::optional<Corners> corners_in_view(const VirtualView& view, const std::array<const Ray*, 4>& rays) {
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::optional<glm::dvec2> pixel = view.pixel(**rays[i]);
    if (!pixel) return std::nullopt;
    corners[i] = *pixel + 0.5;  // measured from the corner of the layer, as pyramids are
  }
  return corners;
}

// Longest side of a pixel's image, in view pixels.
double span_of(const Corners& c) {
  return std::max(
      {glm::distance(c[0], c[1]), glm::distance(c[2], c[3]), glm::distance(c[0], c[2]), glm::distance(c[1], c[3])});
}

// Bilinear reading reaches a texel beyond the layer, and a texel is no more than the pixel's image or one view pixel.
bool misses(const Corners& corners, const cv::Size& size) {
  const double margin = std::max(1.0, span_of(corners));
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x, corners[3].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y, corners[3].y});
  return right < -margin || bottom < -margin || left > size.width + margin || top > size.height + margin;
}

// Adds weight times the bilinear value at (x, y), in texels from the corner of the level; outside is empty.
void add_bilinear(const LayerPyramid::Level& level, double x, double y, float weight, Sample& sum) {
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const auto right_share = static_cast<float>(x - 0.5 - left);
  const auto lower_share = static_cast<float>(y - 0.5 - top);
  for (int dj = 0; dj < 2; ++dj)
    for (int di = 0; di < 2; ++di) {
      const double i = left + di;
      const double j = top + dj;
      if (i < 0 || j < 0 || i >= level.color.cols || j >= level.color.rows) continue;
      const float share = weight * (di == 0 ? 1 - right_share : right_share) * (dj == 0 ? 1 - lower_share : lower_share);
      sum.color += share * level.color.at<cv::Vec4f>(static_cast<int>(j), static_cast<int>(i));
      sum.coverage += share * level.coverage.at<float>(static_cast<int>(j), static_cast<int>(i));
    }
}

// Mean over the quadrilateral. The level is chosen so that it spans two to four texels. With taps half a texel apart or
// closer, what one texel adds up to over all pixels is right to within 2 / (2.5 pi)^2 = 3 % each way (the spectrum of its
// tent at the taps' frequency), and without that limit over several texels; a surface of one colour is always exact.
Sample mean_over(const LayerPyramid& pyramid, const Corners& c) {
  const double span = span_of(c);
  const int wanted = span > 4 ? static_cast<int>(std::ceil(std::log2(span / 4))) : 0;
  const int n = std::min(wanted, pyramid.level_count() - 1);
  const double texel = std::ldexp(1.0, n);
  constexpr double kRounding = 1e-6;  // must not make a third tap of a span of one texel
  const int taps = std::clamp(static_cast<int>(std::ceil(2 * span / texel - kRounding)), 1, 64);
  const LayerPyramid::Level& level = pyramid.level(n);
  const float weight = 1.0F / static_cast<float>(taps * taps);
  Sample sum;
  for (int j = 0; j < taps; ++j)
    for (int i = 0; i < taps; ++i) {
      const double u = (i + 0.5) / taps;
      const double v = (j + 0.5) / taps;
      const glm::dvec2 p = ((1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[2] + u * c[3])) / texel;
      add_bilinear(level, p.x, p.y, weight, sum);
    }
  return sum;
}

}  // namespace

Layer bent(std::span<const DrawnView> views, const Camera& camera, const cv::Rect& target) {
  ENSURE(!views.empty());
  Layer out{target, cv::Mat::zeros(target.size(), CV_32FC4), cv::Mat::zeros(target.size(), CV_32FC1)};
  std::vector<Source> sources;
  for (const DrawnView& drawn : views) sources.push_back({&drawn.view, LayerPyramid(drawn.layer)});
  const std::vector<Ray> rays = corner_rays(camera, target);
  const int stride = target.width + 1;
  for (int j = 0; j < target.height; ++j) {
    for (int i = 0; i < target.width; ++i) {
      const Ray* upper = &rays[static_cast<std::size_t>(j * stride + i)];
      const Ray* lower = upper + stride;
      if (!upper[0] || !upper[1] || !lower[0] || !lower[1]) continue;
      const Source& source = nearest_source(sources, *upper[0]);
      const std::optional<Corners> corners = corners_in_view(*source.view, {upper, upper + 1, lower, lower + 1});
      if (!corners || misses(*corners, source.view->size_px)) continue;
      const Sample sample = mean_over(source.pyramid, *corners);
      out.color.at<cv::Vec4f>(j, i) = sample.color;
      out.coverage.at<float>(j, i) = sample.coverage;
    }
  }
  return out;
}

}  // namespace sigs
