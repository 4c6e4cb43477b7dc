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
    for (int i = 0; i <= target.width; ++i) rays.push_back(camera.lens.ray({target.x + i - 0.5, target.y + j - 0.5}));
  return rays;
}

// The view that looks most nearly along the ray.
const Source& nearest_source(std::span<const Source> sources, const glm::dvec3& ray) {
  const auto along_axis = [&ray](const Source& source) { return (source.view->view_from_camera.rotation * ray).x; };
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
      const float share =
          weight * (di == 0 ? 1 - right_share : right_share) * (dj == 0 ? 1 - lower_share : lower_share);
      sum.color += share * level.color.at<cv::Vec4f>(static_cast<int>(j), static_cast<int>(i));
      sum.coverage += share * level.coverage.at<float>(static_cast<int>(j), static_cast<int>(i));
    }
}

// How a pixel's image in the view is read: from which level, and with how many taps along its two sides.
struct Reading {
  int level = 0;
  double texel = 1;  // of that level, in view pixels
  int taps_across = 1;
  int taps_down = 1;
  bool is_point = false;  // the whole layer is so small in the pixel's image that taps could miss it
};

int level_with(double span, double most_texels) {
  return span > most_texels ? static_cast<int>(std::ceil(std::log2(span / most_texels))) : 0;
}

// The level is chosen so that the shorter side spans two to four texels, the longer one no more than 32. With taps half
// a texel apart or closer, what one texel adds up to over all pixels is right to within 2 / (2.5 pi)^2 = 3 % each way
// (the spectrum of its tent at the taps' frequency), and without that limit over several texels; a surface of one
// colour is always exact.
Reading reading_of(const Corners& c, int level_count) {
  constexpr double kRounding = 1e-6;  // must not make a third tap of a span of one texel
  constexpr double kMostTexels = 32;
  const double across = std::max(glm::distance(c[0], c[1]), glm::distance(c[2], c[3]));
  const double down = std::max(glm::distance(c[0], c[2]), glm::distance(c[1], c[3]));
  const int wanted = std::max(level_with(std::min(across, down), 4), level_with(std::max(across, down), kMostTexels));
  Reading reading{.level = std::min(wanted, level_count - 1)};
  reading.texel = std::ldexp(1.0, reading.level);
  const auto taps = [&reading](double span) {
    return static_cast<int>(std::clamp(std::ceil(2 * span / reading.texel - kRounding), 1.0, 2 * kMostTexels));
  };
  reading.taps_across = taps(across);
  reading.taps_down = taps(down);
  reading.is_point = std::max(across, down) > kMostTexels * reading.texel;
  return reading;
}

// Bilinear reading reaches a texel beyond the layer.
bool misses(const Corners& corners, const cv::Size& size, double texel) {
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x, corners[3].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y, corners[3].y});
  return right < -texel || bottom < -texel || left > size.width + texel || top > size.height + texel;
}

// Mean over the quadrilateral.
Sample mean_over(const LayerPyramid& pyramid, const Corners& c, const Reading& reading) {
  const LayerPyramid::Level& level = pyramid.level(reading.level);
  const float weight = 1.0F / static_cast<float>(reading.taps_across * reading.taps_down);
  Sample sum;
  for (int j = 0; j < reading.taps_down; ++j)
    for (int i = 0; i < reading.taps_across; ++i) {
      const double u = (i + 0.5) / reading.taps_across;
      const double v = (j + 0.5) / reading.taps_down;
      const glm::dvec2 p = ((1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[2] + u * c[3])) / reading.texel;
      add_bilinear(level, p.x, p.y, weight, sum);
    }
  return sum;
}

// The layer as a point in its middle: the one pixel around it takes all of its energy. texel: the last level's.
Sample mean_of_point(const LayerPyramid::Level& last, const cv::Size& size, const Corners& c, double texel) {
  const glm::dvec2 point(size.width / 2.0, size.height / 2.0);
  const std::array<glm::dvec2, 4> round{c[0], c[1], c[3], c[2]};
  bool inside = false;
  double doubled_area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 a = round[i] - point;
    const glm::dvec2 b = round[(i + 1) % 4] - point;
    doubled_area += a.x * b.y - b.x * a.y;
    if ((a.y > 0) != (b.y > 0) && a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0) inside = !inside;
  }
  if (!inside || doubled_area == 0) return {};
  const auto share = static_cast<float>(2 * texel * texel / std::abs(doubled_area));
  return {last.color.at<cv::Vec4f>(0, 0) * share, last.coverage.at<float>(0, 0) * share};
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
      if (!corners) continue;
      const Reading reading = reading_of(*corners, source.pyramid.level_count());
      const cv::Size& size = source.view->size_px;
      if (misses(*corners, size, reading.texel)) continue;
      const Sample sample = reading.is_point
                                ? mean_of_point(source.pyramid.level(reading.level), size, *corners, reading.texel)
                                : mean_over(source.pyramid, *corners, reading);
      out.color.at<cv::Vec4f>(j, i) = sample.color;
      out.coverage.at<float>(j, i) = sample.coverage;
    }
  }
  return out;
}

}  // namespace sigs
