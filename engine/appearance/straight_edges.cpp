// SPDX-License-Identifier: MIT
#include "appearance/edge_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace sigs {

namespace {

constexpr int kCell_px = 20;         // at most one edge begins in each
constexpr double kBin_px = 0.25;     // as ISO 12233
constexpr double kMinContrast = 30;  // code values
constexpr double kContrastToNoise = 12;
constexpr double kMaxBend_px = 0.15;                      // of the line over its length
constexpr double kMaxUnevenness = 0.05;                   // of each side, as a share of the contrast
constexpr std::array<double, 2> kHalfLengths_px{12, 40};  // the longer one for edges that are nearly level or upright
constexpr int kMaxTried = 400;                            // candidates of a frame

struct Gradients {
  cv::Mat x, y;  // CV_16S, 8 times the slope
};

Gradients gradients_of(const cv::Mat& luma) {
  Gradients found;
  cv::spatialGradient(luma, found.x, found.y);
  return found;
}

glm::dvec2 gradient_at(const Gradients& gradients, int x, int y) {
  return {gradients.x.at<short>(y, x), gradients.y.at<short>(y, x)};
}

// Sizes of the gradients in one row, and the largest size of each column so far.
void add_strength(const short* gx, const short* gy, short* strength, std::vector<short>& most) {
  for (std::size_t x = 0; x < most.size(); ++x) {
    strength[x] = static_cast<short>(std::abs(gx[x]) + std::abs(gy[x]));
    most[x] = std::max(most[x], strength[x]);
  }
}

// The strongest gradient of each cell, strongest first.
std::vector<cv::Point> candidates(const Gradients& gradients) {
  constexpr int kMargin = 10;
  constexpr int kMinGradient = 40;  // 5 codes a pixel
  struct Found {
    int size = 0;
    cv::Point at;
  };
  std::vector<Found> all;
  const cv::Size size = gradients.x.size();
  cv::Mat_<short> strength(kCell_px, size.width);
  std::vector<short> most(static_cast<std::size_t>(size.width));  // of each column
  for (int top = kMargin; top + kCell_px + kMargin <= size.height; top += kCell_px) {
    std::fill(most.begin(), most.end(), short{0});
    for (int row = 0; row < kCell_px; ++row)
      add_strength(gradients.x.ptr<short>(top + row), gradients.y.ptr<short>(top + row), strength[row], most);
    for (int left = kMargin; left + kCell_px + kMargin <= size.width; left += kCell_px) {
      const short best = *std::max_element(most.begin() + left, most.begin() + left + kCell_px);
      if (best < kMinGradient) continue;
      for (int row = 0; row < kCell_px; ++row) {
        const short* const end = strength[row] + left + kCell_px;
        const short* const at = std::find<const short*>(strength[row] + left, end, best);
        if (at == end) continue;
        all.push_back({best, {static_cast<int>(at - strength[row]), top + row}});
        break;
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.size > b.size; });
  std::vector<cv::Point> points;
  for (const Found& found : all) points.push_back(found.at);
  return points;
}

struct Span {
  double from = 0, to = 0;
};

// The part of a span of x in which |x direction.x + y direction.y| <= reach.
Span within(Span span, const glm::dvec2& direction, double y, double reach) {
  constexpr double kAlongRow = 1e-6;
  if (std::abs(direction.x) < kAlongRow) return span;
  const double a = (-reach - y * direction.y) / direction.x, b = (reach - y * direction.y) / direction.x;
  return {std::max(span.from, std::min(a, b)), std::min(span.to, std::max(a, b))};
}

// Calls work(x, y, along, across) for each pixel near the line.
template <class Work>
void each_near(const EdgeLine& line, double half_width_px, cv::Size size, const Work& work) {
  const glm::dvec2 along(-line.normal.y, line.normal.x);
  const glm::dvec2 reach = glm::abs(along) * line.half_length_px + glm::abs(line.normal) * half_width_px;
  const int left = std::max(0, static_cast<int>(std::ceil(line.at_px.x - reach.x)));
  const int right = std::min(size.width - 1, static_cast<int>(std::floor(line.at_px.x + reach.x)));
  const int top = std::max(0, static_cast<int>(std::ceil(line.at_px.y - reach.y)));
  const int bottom = std::min(size.height - 1, static_cast<int>(std::floor(line.at_px.y + reach.y)));
  for (int y = top; y <= bottom; ++y) {
    const double down = y - line.at_px.y;
    const Span span = within(within({left - line.at_px.x, right - line.at_px.x}, along, down, line.half_length_px),
                             line.normal, down, half_width_px);
    const int end = std::min(right, static_cast<int>(std::floor(line.at_px.x + span.to)) + 1);
    for (int x = std::max(left, static_cast<int>(std::ceil(line.at_px.x + span.from)) - 1); x <= end; ++x) {
      const glm::dvec2 from = glm::dvec2(x, y) - line.at_px;
      const double t = glm::dot(from, along);
      const double d = glm::dot(from, line.normal);
      if (std::abs(t) <= line.half_length_px && std::abs(d) <= half_width_px) work(x, y, t, d);
    }
  }
}

// The direction in which brightness rises around a point, where most gradients agree on it.
std::optional<glm::dvec2> normal_at(const Gradients& gradients, cv::Point at) {
  constexpr int kRadius = 5;
  constexpr double kMinCoherence = 0.85;
  double xx = 0, xy = 0, yy = 0;
  glm::dvec2 sum(0);
  for (int y = at.y - kRadius; y <= at.y + kRadius; ++y) {
    for (int x = at.x - kRadius; x <= at.x + kRadius; ++x) {
      const glm::dvec2 g = gradient_at(gradients, x, y);
      xx += g.x * g.x;
      xy += g.x * g.y;
      yy += g.y * g.y;
      sum += g;
    }
  }
  const double difference = std::hypot(xx - yy, 2 * xy);
  if (!(difference > kMinCoherence * (xx + yy))) return std::nullopt;
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const glm::dvec2 normal(std::cos(angle), std::sin(angle));
  return glm::dot(normal, sum) < 0 ? -normal : normal;
}

// The line through the middles of the gradient, slice by slice along it; nothing where these are not on a line.
std::optional<EdgeLine> refined(const Gradients& gradients, EdgeLine line) {
  constexpr int kSlices = 8;
  double bend_px = 0;
  for (const double half_width_px : {4.0, 4.0, 5.0}) {
    std::array<double, kSlices> weight{}, sum_d{}, sum_t{};
    each_near(line, half_width_px, gradients.x.size(), [&](int x, int y, double t, double d) {
      const double slope = glm::dot(gradient_at(gradients, x, y), line.normal);
      if (!(slope > 0)) return;
      const int slice = std::clamp(static_cast<int>((t / line.half_length_px + 1) * kSlices / 2), 0, kSlices - 1);
      const double w = slope * slope;
      weight[slice] += w;
      sum_d[slice] += w * d;
      sum_t[slice] += w * t;
    });
    double n = 0, t1 = 0, t2 = 0, d1 = 0, dt = 0;
    for (int i = 0; i < kSlices; ++i) {
      if (!(weight[i] > 0)) return std::nullopt;
      sum_d[i] /= weight[i];
      sum_t[i] /= weight[i];
      n += 1;
      t1 += sum_t[i];
      t2 += sum_t[i] * sum_t[i];
      d1 += sum_d[i];
      dt += sum_d[i] * sum_t[i];
    }
    const double determinant = n * t2 - t1 * t1;
    if (!(determinant > 0)) return std::nullopt;
    const double tilt = (n * dt - t1 * d1) / determinant;
    const double shift = (d1 - tilt * t1) / n;
    double squares = 0;
    for (int i = 0; i < kSlices; ++i) squares += std::pow(sum_d[i] - shift - tilt * sum_t[i], 2);
    bend_px = std::sqrt(squares / kSlices);
    const glm::dvec2 along(-line.normal.y, line.normal.x);
    line.at_px += shift * line.normal;
    line.normal = glm::normalize(line.normal - tilt * along);
  }
  if (bend_px > kMaxBend_px) return std::nullopt;
  return line;
}

struct Side {
  double mean = 0;
  double deviation = 0;
};

struct Sides {
  Side dark, bright;
};

Sides sides_of(const cv::Mat& luma, const EdgeLine& line) {
  struct Sums {
    double n = 0, sum = 0, squares = 0;

    [[nodiscard]] Side side() const {
      if (n < 1) return {0, INFINITY};
      return {sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)))};
    }
  };
  Sums dark, bright;
  each_near(line, kEdgeHalfWidth_px, luma.size(), [&](int x, int y, double, double d) {
    if (std::abs(d) < 5) return;
    Sums& side = d < 0 ? dark : bright;
    const double code = luma.at<uchar>(y, x);
    side.n += 1;
    side.sum += code;
    side.squares += code * code;
  });
  return {dark.side(), bright.side()};
}

// Whether every quarter of a pixel near the edge has samples.
bool is_well_sampled(const EdgeBins& bins) {
  constexpr double kCore_px = 4;
  int there = 0;
  for (const double d : bins.distance_px) there += std::abs(d) <= kCore_px ? 1 : 0;
  return there >= 0.9 * 2 * kCore_px / kBin_px;
}

double steepness_of(const EdgeBins& bins, double contrast) {
  double steepest = 0;
  for (std::size_t i = 0; i + 4 < bins.code.size(); ++i) {
    const double step_px = bins.distance_px[i + 4] - bins.distance_px[i];
    if (std::abs(bins.distance_px[i + 2]) < 2)
      steepest = std::max(steepest, (bins.code[i + 4] - bins.code[i]) / step_px);
  }
  return steepest / contrast;
}

bool is_clipped(const EdgeBins& bins, int lowest, int highest) {
  return std::any_of(bins.code.begin(), bins.code.end(),
                     [&](double code) { return code < lowest + 1 || code > highest - 1; });
}

std::optional<StraightEdge> edge_along(const cv::Mat& luma, const Gradients& gradients, EdgeLine line, int lowest,
                                       int highest) {
  const std::optional<EdgeLine> fitted = refined(gradients, line);
  if (!fitted) return std::nullopt;
  const glm::dvec2 along(-fitted->normal.y, fitted->normal.x);
  const glm::dvec2 reach = glm::abs(along) * fitted->half_length_px + glm::abs(fitted->normal) * kEdgeHalfWidth_px;
  const glm::dvec2 last(luma.cols - 2, luma.rows - 2);
  if (glm::any(glm::lessThan(fitted->at_px - reach, glm::dvec2(1))) ||
      glm::any(glm::greaterThan(fitted->at_px + reach, last)))
    return std::nullopt;
  const auto [dark, bright] = sides_of(luma, *fitted);
  const double contrast = bright.mean - dark.mean;
  if (!(contrast >= kMinContrast)) return std::nullopt;
  StraightEdge edge{.line = *fitted, .dark = dark.mean, .bright = bright.mean};
  edge.bins = binned(luma, {}, *fitted, kEdgeHalfWidth_px, kBin_px);
  if (!is_well_sampled(edge.bins) || is_clipped(edge.bins, lowest, highest)) return std::nullopt;
  const double noise = std::min(dark.deviation, bright.deviation);
  const double uneven = kMaxUnevenness * contrast;
  if (dark.deviation > uneven || bright.deviation > uneven || edge.bins.noise > uneven) return std::nullopt;
  if (contrast < kContrastToNoise * std::max(noise, 0.5)) return std::nullopt;
  edge.steepness = steepness_of(edge.bins, contrast);
  return edge;
}

}  // namespace

EdgeBins binned(const cv::Mat& plane, const PlaneGrid& grid, const EdgeLine& line, double half_width_px,
                double bin_px) {
  const int count = 2 * static_cast<int>(std::lround(half_width_px / bin_px));
  std::vector<double> n(count), distance(count), sum(count), squares(count);
  // The same line in the plane's own samples; the distance is that among luma samples.
  const glm::dvec2 along(-line.normal.y, line.normal.x);
  const glm::dvec2 reach = glm::abs(along) * line.half_length_px + glm::abs(line.normal) * half_width_px;
  const glm::ivec2 low =
      glm::max(glm::ivec2(0), glm::ivec2(glm::ceil((line.at_px - reach - grid.offset_px) / grid.step_px)));
  const glm::ivec2 high = glm::min(glm::ivec2(plane.cols - 1, plane.rows - 1),
                                   glm::ivec2(glm::floor((line.at_px + reach - grid.offset_px) / grid.step_px)));
  const double first_x = grid.offset_px.x - line.at_px.x;  // of the plane's first column, from the line's middle
  for (int y = low.y; y <= high.y; ++y) {
    const double down = y * grid.step_px.y + grid.offset_px.y - line.at_px.y;
    const Span row{low.x * grid.step_px.x + first_x, high.x * grid.step_px.x + first_x};
    const Span span = within(within(row, along, down, line.half_length_px), line.normal, down, half_width_px);
    const int end = std::min(high.x, static_cast<int>(std::floor((span.to - first_x) / grid.step_px.x)) + 1);
    for (int x = std::max(low.x, static_cast<int>(std::ceil((span.from - first_x) / grid.step_px.x)) - 1); x <= end;
         ++x) {
      const glm::dvec2 from = glm::dvec2(x, y) * grid.step_px + grid.offset_px - line.at_px;
      const double d = glm::dot(from, line.normal);
      if (std::abs(glm::dot(from, along)) > line.half_length_px) continue;
      const auto bin = static_cast<int>(std::floor((d + half_width_px) / bin_px));
      if (bin < 0 || bin >= count) continue;
      const double code = plane.at<uchar>(y, x);
      n[bin] += 1;
      distance[bin] += d;
      sum[bin] += code;
      squares[bin] += code * code;
    }
  }
  EdgeBins bins;
  double inside = 0, freedom = 0;
  for (int i = 0; i < count; ++i) {
    if (n[i] < 1) continue;
    bins.distance_px.push_back(distance[i] / n[i]);
    bins.code.push_back(sum[i] / n[i]);
    bins.count.push_back(n[i]);
    inside += squares[i] - sum[i] * sum[i] / n[i];
    freedom += n[i] - 1;
  }
  bins.noise = freedom > 0 ? std::sqrt(std::max(0.0, inside / freedom)) : 0;
  return bins;
}

std::vector<StraightEdge> straight_edges(const cv::Mat& luma, int lowest, int highest, int max_count) {
  std::vector<StraightEdge> edges;
  const Gradients gradients = gradients_of(luma);
  int tried = 0;
  for (const cv::Point at : candidates(gradients)) {
    if (++tried > kMaxTried) break;
    const std::optional<glm::dvec2> normal = normal_at(gradients, at);
    if (!normal) continue;
    for (const double half_length_px : kHalfLengths_px) {
      std::optional<StraightEdge> edge =
          edge_along(luma, gradients, {glm::dvec2(at.x, at.y), *normal, half_length_px}, lowest, highest);
      if (!edge) continue;
      edges.push_back(std::move(*edge));
      break;
    }
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const StraightEdge& a, const StraightEdge& b) { return a.steepness > b.steepness; });
  if (std::ssize(edges) > max_count) edges.resize(static_cast<std::size_t>(max_count));
  return edges;
}

}  // namespace sigs
