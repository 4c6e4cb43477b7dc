// SPDX-License-Identifier: MIT
#include "compositor/warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "base/ensure.h"

namespace sigs {
namespace {

cv::Mat halved(const cv::Mat& image) {
  cv::Mat even = image;
  if (image.cols % 2 != 0 || image.rows % 2 != 0)
    cv::copyMakeBorder(image, even, 0, image.rows % 2, 0, image.cols % 2, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::Mat half;
  cv::resize(even, half, {even.cols / 2, even.rows / 2}, 0, 0, cv::INTER_AREA);  // exact mean at a factor of two
  return half;
}

constexpr int kBlock = 16;

// Whether all bits of a block of samples are 0: integers, which are compared many at a time.
bool is_empty_block(const float* samples) {
  std::array<std::uint64_t, kBlock / 2> bits{};
  std::memcpy(bits.data(), samples, sizeof(bits));
  std::uint64_t all = 0;
  for (const std::uint64_t two : bits) all |= two;
  return all == 0;
}

// Index of the first sample that is not 0, before `end`; `end` where all are.
int first_occupied(const float* samples, int end) {
  int first = 0;
  while (first + kBlock <= end && is_empty_block(samples + first)) first += kBlock;
  while (first < end && samples[first] == 0) ++first;
  return first;
}

// One beyond the last sample that is not 0, from `first` on; `first` where all are.
int end_of_occupied(const float* samples, int first, int end) {
  while (end - kBlock >= first && is_empty_block(samples + end - kBlock)) end -= kBlock;
  while (end > first && samples[end - 1] == 0) --end;
  return end;
}

// Coverage lies closer together than colours, of which only those are read that it leaves in question.
cv::Range span_of_row(const cv::Vec4f* color, const float* coverage, int width) {
  const float* const colors = color->val;
  const int covered = first_occupied(coverage, width);
  const int first = first_occupied(colors, 4 * covered) / 4;
  if (first == width) return {width, width};
  const int end_covered = end_of_occupied(coverage, first, width);
  return {first, (end_of_occupied(colors, 4 * end_covered, 4 * width) + 3) / 4};
}

LayerPyramid::Level level_of(cv::Mat color, cv::Mat coverage) {
  LayerPyramid::Level level{std::move(color), std::move(coverage), {}, {}};
  level.spans.reserve(static_cast<std::size_t>(level.color.rows));
  for (int j = 0; j < level.color.rows; ++j) {
    const cv::Range span = span_of_row(level.color.ptr<cv::Vec4f>(j), level.coverage.ptr<float>(j), level.color.cols);
    level.spans.push_back(span);
    if (span.size() > 0) level.occupied |= cv::Rect(span.start, j, span.size(), 1);
  }
  return level;
}

constexpr int kNone = -1;

struct Source {
  glm::dvec3 axis;         // of the view, camera frame
  glm::dmat3 from_camera;  // x along the axis; y and z times the focal length
  glm::dvec2 center_px;    // measured from the corner of the layer
  AreaReader reader;
};

Source source_of(const RenderedView& drawn) {
  const glm::dmat3 turn = glm::mat3_cast(drawn.view.view_from_camera.rotation);
  const double f = drawn.view.focal_px;
  const glm::dmat3 scale{{1, 0, 0}, {0, f, 0}, {0, 0, f}};
  return {glm::transpose(turn)[0], scale * turn, drawn.view.center_px + 0.5, AreaReader(drawn.layer)};
}

// Where a ray meets the view; not a number behind the view and where there is no ray.
glm::dvec2 projected(const Source& source, const glm::dvec3& ray) {
  const glm::dvec3 p = source.from_camera * ray;
  if (!(p.x > 0)) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  return source.center_px + glm::dvec2(p.y, p.z) / p.x;
}

// The source that looks most nearly along the ray.
int nearest_source(std::span<const Source> sources, const glm::dvec3& ray) {
  if (ray == glm::dvec3(0)) return kNone;
  int nearest = 0;
  double longest = glm::dot(sources[0].axis, ray);
  for (std::size_t i = 1; i < sources.size(); ++i) {
    const double along = glm::dot(sources[i].axis, ray);
    if (along > longest) longest = along, nearest = static_cast<int>(i);
  }
  return nearest;
}

// One row of pixels after the other, with the corners' rays on both sides of it.
class Warper {
 public:
  Warper(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
         const RowTransform& row_transform)
      : lens_(lens), target_(target), row_transform_(row_transform) {
    for (const RenderedView& drawn : views) sources_.push_back(source_of(drawn));
  }

  Layer layer() {
    Layer out{target_, cv::Mat::zeros(target_.size(), CV_32FC4), cv::Mat::zeros(target_.size(), CV_32FC1)};
    if (target_.empty()) return out;
    find_lower_rays(0);
    for (int j = 0; j < target_.height; ++j) {
      std::swap(upper_, lower_);
      find_lower_rays(j + 1);
      warp_row(out.color.ptr<cv::Vec4f>(j), out.coverage.ptr<float>(j));
    }
    return out;
  }

 private:
  void find_lower_rays(int j) {
    const std::span<const glm::dvec3> rays = lens_.corner_rays(target_.x, target_.y + j, target_.width + 1);
    lower_.assign(rays.begin(), rays.end());
    if (!row_transform_) return;
    const RowMotion::Turn turn = row_transform_(target_.y + j - 0.5);
    for (glm::dvec3& ray : lower_) ray = turn * ray;
  }

  // Pixels that ask the same source, one run after the other.
  void warp_row(cv::Vec4f* color, float* coverage) {
    for (int i = 0; i < target_.width;) {
      const int nearest = nearest_source(sources_, upper_[static_cast<std::size_t>(i)]);
      int end = i + 1;
      while (end < target_.width && nearest_source(sources_, upper_[static_cast<std::size_t>(end)]) == nearest) ++end;
      if (nearest != kNone) warp_run(sources_[static_cast<std::size_t>(nearest)], i, end, color, coverage);
      i = end;
    }
  }

  void warp_run(Source& source, int first, int end, cv::Vec4f* color, float* coverage) {
    glm::dvec2 upper_left = projected(source, upper_[static_cast<std::size_t>(first)]);
    glm::dvec2 lower_left = projected(source, lower_[static_cast<std::size_t>(first)]);
    for (int i = first; i < end; ++i) {
      const glm::dvec2 upper_right = projected(source, upper_[static_cast<std::size_t>(i) + 1]);
      const glm::dvec2 lower_right = projected(source, lower_[static_cast<std::size_t>(i) + 1]);
      const AreaMean mean = source.reader.mean_over({upper_left, upper_right, lower_right, lower_left});
      color[i] = mean.color;
      coverage[i] = mean.coverage;
      upper_left = upper_right;
      lower_left = lower_right;
    }
  }

  LensTable& lens_;
  cv::Rect target_;
  const RowTransform& row_transform_;
  std::vector<Source> sources_;
  std::vector<glm::dvec3> upper_;
  std::vector<glm::dvec3> lower_;
};

}  // namespace

LayerPyramid::LayerPyramid(const Layer& layer) {
  ENSURE(!layer.color.empty() && layer.color.size() == layer.coverage.size());
  levels_.push_back(level_of(layer.color, layer.coverage));
  for (int side = std::max(layer.color.cols, layer.color.rows); side > 1; side = (side + 1) / 2) ++level_count_;
}

const LayerPyramid::Level& LayerPyramid::level(int n) {
  ENSURE(n >= 0 && n < level_count_);
  while (static_cast<int>(levels_.size()) <= n)
    levels_.push_back(level_of(halved(levels_.back().color), halved(levels_.back().coverage)));
  return levels_[static_cast<std::size_t>(n)];
}

namespace {

constexpr double kMaxTexelsShort = 16;  // above any supersampling: a coarser level's texels lie across edges
constexpr double kMaxTexelsLong = 64;

struct Bounds {
  glm::dvec2 low, high;
};

Bounds bounds_of(const Quadrilateral& c) {
  return {glm::min(glm::min(c[0], c[1]), glm::min(c[2], c[3])), glm::max(glm::max(c[0], c[1]), glm::max(c[2], c[3]))};
}

// Positive where the corners run clockwise as seen on the screen (y down).
double signed_area(const Quadrilateral& c) {
  const glm::dvec2 a = c[2] - c[0];
  const glm::dvec2 b = c[3] - c[1];
  return 0.5 * (a.x * b.y - a.y * b.x);
}

// Length of the longer of two opposite sides.
double longer(const glm::dvec2& a, const glm::dvec2& b) {
  return std::sqrt(std::max(glm::dot(a, a), glm::dot(b, b)));
}

int level_with(double span, double max_texels) {
  return span > max_texels ? static_cast<int>(std::ceil(std::log2(span / max_texels))) : 0;
}

// across and down: lengths of the sides, of which at least one is below 1.
Quadrilateral widened(const Quadrilateral& c, double across, double down) {
  const glm::dvec2 middle = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  const glm::dvec2 right = std::max(1.0, 1 / across) * 0.25 * (c[1] - c[0] + c[2] - c[3]);
  const glm::dvec2 low = std::max(1.0, 1 / down) * 0.25 * (c[3] - c[0] + c[2] - c[1]);
  return {middle - right - low, middle + right - low, middle + right + low, middle - right + low};
}

// Part of [low, high) that holds the texels touched by [from, to].
cv::Range touched(double from, double to, int low, int high) {
  return {static_cast<int>(std::clamp(std::floor(from), double(low), double(high))),
          static_cast<int>(std::clamp(std::ceil(to), double(low), double(high)))};
}

}  // namespace

// Green's theorem: the area left of a line x = k within a band of y is the sum over the edges, each cut to the band, of
// dy times the mean of max(k - x, 0) along it. Fills lefts_ for k = first .. end of the band [top, top + 1].
void AreaReader::find_row_areas(const std::array<Edge, 4>& edges, double top, int first, int end) {
  const auto count = static_cast<std::size_t>(end - first + 1);
  lefts_.assign(count, 0.0);
  for (const Edge& edge : edges) {
    const double y_from = std::clamp(edge.from.y, top, top + 1);
    const double y_to = std::clamp(edge.to.y, top, top + 1);
    const double dy = y_from - y_to;
    if (dy == 0) continue;
    const double x_from = edge.from.x + (y_from - edge.from.y) * edge.slope;
    const double x_to = edge.from.x + (y_to - edge.from.y) * edge.slope;
    const double low = std::min(x_from, x_to);
    const double high = std::max(x_from, x_to);
    const double middle = 0.5 * (low + high);
    for (std::size_t n = 0; n < count; ++n) {
      const double line = first + static_cast<double>(n);
      if (line >= high)
        lefts_[n] += dy * (line - middle);
      else if (line > low)
        lefts_[n] += dy * (line - low) * (line - low) / (2 * (high - low));
    }
  }
}

//   corners  clockwise, in texels of the level
AreaMean AreaReader::mean_over_texels(const LayerPyramid::Level& level, const Quadrilateral& corners) {
  const Bounds bounds = bounds_of(corners);
  const cv::Rect& occupied = level.occupied;
  const cv::Range rows = touched(bounds.low.y, bounds.high.y, occupied.y, occupied.y + occupied.height);
  const cv::Range columns = touched(bounds.low.x, bounds.high.x, occupied.x, occupied.x + occupied.width);
  if (columns.empty()) return {};
  std::array<Edge, 4> edges;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2& from = corners[i];
    const glm::dvec2& to = corners[(i + 1) % 4];
    edges[i] = {from, to, from.y == to.y ? 0.0 : (to.x - from.x) / (to.y - from.y)};
  }
  const double per_area = 1 / signed_area(corners);
  AreaMean mean;
  float total = 0;
  for (int row = rows.start; row < rows.end; ++row) {
    const cv::Range span = level.spans[static_cast<std::size_t>(row)] & columns;
    if (span.start >= span.end) continue;
    find_row_areas(edges, row, span.start, span.end);
    const cv::Vec4f* color = level.color.ptr<cv::Vec4f>(row);
    const float* coverage = level.coverage.ptr<float>(row);
    for (int i = span.start; i < span.end; ++i) {
      const auto n = static_cast<std::size_t>(i - span.start);
      const auto share = static_cast<float>(std::max(0.0, (lefts_[n + 1] - lefts_[n]) * per_area));
      for (int c = 0; c < 4; ++c) mean.color[c] += share * color[i][c];
      mean.coverage += share * coverage[i];
      total += share;
    }
  }
  if (total > 1) {  // rounding; or a pixel at a fold of the lens, whose four rays make no convex figure
    mean.color *= 1 / total;
    mean.coverage /= total;
  }
  return mean;
}

AreaMean AreaReader::mean_over(const Quadrilateral& corners) {
  const double area = signed_area(corners);
  if (area == 0 || !std::isfinite(area)) return {};
  const Bounds bounds = bounds_of(corners);
  const cv::Rect& occupied = pyramid_.level(0).occupied;
  // Widening adds half a texel at most, and a coarser level's texels, which may reach beyond the occupied ones below
  // them, are smaller than an eighth of the longer side.
  const double margin = 1 + 0.5 * std::max(bounds.high.x - bounds.low.x, bounds.high.y - bounds.low.y);
  if (occupied.empty() || bounds.high.x < occupied.x - margin || bounds.high.y < occupied.y - margin ||
      bounds.low.x > occupied.x + occupied.width + margin || bounds.low.y > occupied.y + occupied.height + margin)
    return {};
  const Quadrilateral clockwise = area > 0 ? corners : Quadrilateral{corners[0], corners[3], corners[2], corners[1]};
  const double across = longer(clockwise[1] - clockwise[0], clockwise[2] - clockwise[3]);
  const double down = longer(clockwise[3] - clockwise[0], clockwise[2] - clockwise[1]);
  const auto [shorter_side, longer_side] = std::minmax({across, down});
  if (shorter_side < 1) return mean_over_texels(pyramid_.level(0), widened(clockwise, across, down));
  const int wanted = std::max(level_with(shorter_side, kMaxTexelsShort), level_with(longer_side, kMaxTexelsLong));
  const int level = std::min(wanted, pyramid_.level_count() - 1);
  if (level == 0) return mean_over_texels(pyramid_.level(0), clockwise);
  Quadrilateral scaled = clockwise;
  for (glm::dvec2& corner : scaled) corner *= std::ldexp(1.0, -level);
  return mean_over_texels(pyramid_.level(level), scaled);
}

Layer warped(std::span<const RenderedView> views, LensTable& lens, const cv::Rect& target,
             const RowTransform& row_transform) {
  ENSURE(!views.empty());
  return Warper(views, lens, target, row_transform).layer();
}

Layer warped(std::span<const RenderedView> views, const Camera& camera, const cv::Rect& target) {
  LensTable lens(camera);
  return warped(views, lens, target);
}

}  // namespace sigs
