// SPDX-License-Identifier: MIT
#include "compositor/area_reader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <span>

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

// Numbers that processors work on at a time, each as it would be alone.
constexpr int kLanes = 4;
using Doubles [[gnu::vector_size(kLanes * sizeof(double))]] = double;
using Color [[gnu::vector_size(4 * sizeof(float))]] = float;

struct Edge {
  glm::dvec2 from, to;
  double slope = 0;  // dx / dy
};

// Part of an edge within a band of y: its height, with the sign of its direction, and where it is in x.
struct Cut {
  double dy = 0;
  double low = 0, high = 0;
};

// Returns how many of the edges have a part in the band [top, top + 1].
[[gnu::always_inline]] inline int cut_edges(const std::array<Edge, 4>& edges, double top, std::array<Cut, 4>& cuts) {
  int count = 0;
  for (const Edge& edge : edges) {
    const double y_from = std::clamp(edge.from.y, top, top + 1);
    const double y_to = std::clamp(edge.to.y, top, top + 1);
    if (y_from == y_to) continue;
    const double x_from = edge.from.x + (y_from - edge.from.y) * edge.slope;
    const double x_to = edge.from.x + (y_to - edge.from.y) * edge.slope;
    cuts[static_cast<std::size_t>(count++)] = {y_from - y_to, std::min(x_from, x_to), std::max(x_from, x_to)};
  }
  return count;
}

// Green's theorem: the area left of a line x = k within a band of y is the sum over the edges, each cut to the band, of
// dy times the mean of max(k - x, 0) along it. Fills lefts for k = first, first + 1, ...
[[gnu::always_inline]] inline void find_row_areas(std::span<const Cut> cuts, int first, std::span<double> lefts) {
  const double start = first;
  Doubles line{start, start + 1, start + 2, start + 3};
  for (std::size_t n = 0; n < lefts.size(); n += kLanes, line += double{kLanes}) {
    Doubles left{};
    for (const Cut& cut : cuts) {
      const Doubles inside = line - cut.low;
      const Doubles beyond = cut.dy * (line - 0.5 * (cut.low + cut.high));
      const Doubles between = cut.dy * inside * inside / (2 * (cut.high - cut.low));
      left += line >= cut.high ? beyond : (line > cut.low ? between : Doubles{});
    }
    std::memcpy(lefts.data() + n, &left, sizeof(left));
  }
}

//   corners  clockwise, in texels of the level
//   lefts    memory, kept from call to call
[[gnu::always_inline]] inline AreaMean mean_over_texels(const LayerPyramid::Level& level, const Quadrilateral& corners,
                                                        std::vector<double>& lefts) {
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
  Color color{};
  float coverage = 0;
  float total = 0;
  for (int row = rows.start; row < rows.end; ++row) {
    const cv::Range span = level.spans[static_cast<std::size_t>(row)] & columns;
    if (span.start >= span.end) continue;
    std::array<Cut, 4> cuts;
    const int count = cut_edges(edges, row, cuts);
    lefts.resize(static_cast<std::size_t>((span.size() + kLanes) / kLanes * kLanes));  // a line on each side of a texel
    find_row_areas(std::span(cuts).first(static_cast<std::size_t>(count)), span.start, lefts);
    const cv::Vec4f* const colors = level.color.ptr<cv::Vec4f>(row);
    const float* const coverages = level.coverage.ptr<float>(row);
    for (int i = span.start; i < span.end; ++i) {
      const auto n = static_cast<std::size_t>(i - span.start);
      const auto share = static_cast<float>(std::max(0.0, (lefts[n + 1] - lefts[n]) * per_area));
      Color texel;
      std::memcpy(&texel, colors[i].val, sizeof(texel));
      color += share * texel;
      coverage += share * coverages[i];
      total += share;
    }
  }
  AreaMean mean{{color[0], color[1], color[2], color[3]}, coverage};
  if (total > 1) {  // rounding; or a pixel at a fold of the lens, whose four rays make no convex figure
    mean.color *= 1 / total;
    mean.coverage /= total;
  }
  return mean;
}

#ifdef __x86_64__
// The same bits, with the vectors that most processors since 2013 have.
[[gnu::target("avx2")]] AreaMean mean_since_2013(const LayerPyramid::Level& level, const Quadrilateral& corners,
                                                 std::vector<double>& lefts) {
  return mean_over_texels(level, corners, lefts);
}
#endif

constexpr int kChannels = 4;

// Code values of 8 bits, not rounded: red, green, blue, opacity.
cv::Mat codes_of(const cv::Mat& color) {
  cv::Mat codes;
  cv::sqrt(color.reshape(1), codes);
  for (int j = 0; j < codes.rows; ++j) {
    const float* const from = color.ptr<float>(j);
    float* const to = codes.ptr<float>(j);
    for (int i = 0; i < codes.cols; i += kChannels) {
      for (int c = 0; c < kChannels - 1; ++c) to[i + c] *= 255.0F;
      to[i + kChannels - 1] = 255.0F * from[i + kChannels - 1];
    }
  }
  return codes;
}

// Fills bends for i = kChannels .. size - kChannels - 1.
void find_bends(const cv::Mat& codes, int row, std::vector<float>& bends) {
  const float* const above = codes.ptr<float>(row - 1);
  const float* const here = codes.ptr<float>(row);
  const float* const below = codes.ptr<float>(row + 1);
  for (int i = kChannels; i < codes.cols - kChannels; ++i) {
    const float across = std::abs(here[i - kChannels] + here[i + kChannels] - 2 * here[i]);
    const float down = std::abs(above[i] + below[i] - 2 * here[i]);
    bends[static_cast<std::size_t>(i)] = across > down ? across : down;
  }
}

}  // namespace

LayerPyramid::LayerPyramid(const Layer& layer) {
  ENSURE(!layer.color.empty() && layer.color.size() == layer.coverage.size());
  levels_.push_back(level_of(layer.color, layer.coverage));
  for (int side = std::max(layer.color.cols, layer.color.rows); side > 1; side = (side + 1) / 2) ++level_count_;
}

LayerPyramid LayerPyramid::of_parts(const Layer& layer) {
  LayerPyramid pyramid;
  const cv::Size size = layer.color.size();
  const std::vector<cv::Range> rows(static_cast<std::size_t>(size.height), {0, size.width});
  pyramid.levels_.push_back({layer.color, layer.coverage, rows, {{0, 0}, size}});
  return pyramid;
}

const LayerPyramid::Level& LayerPyramid::level(int n) {
  ENSURE(n >= 0 && n < level_count_);
  while (static_cast<int>(levels_.size()) <= n)
    levels_.push_back(level_of(halved(levels_.back().color), halved(levels_.back().coverage)));
  return levels_[static_cast<std::size_t>(n)];
}

AreaMean AreaReader::mean_in(int level, const Quadrilateral& corners) {
#ifdef __x86_64__
  static const bool is_since_2013 = __builtin_cpu_supports("avx2") != 0;
  if (is_since_2013) return mean_since_2013(pyramid_.level(level), corners, lefts_);
#endif
  return mean_over_texels(pyramid_.level(level), corners, lefts_);
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
  if (shorter_side < 1) return mean_in(0, widened(clockwise, across, down));
  const int wanted = std::max(level_with(shorter_side, kMaxTexelsShort), level_with(longer_side, kMaxTexelsLong));
  const int level = std::min(wanted, pyramid_.level_count() - 1);
  if (level == 0) return mean_in(0, clockwise);
  Quadrilateral scaled = clockwise;
  for (glm::dvec2& corner : scaled) corner *= std::ldexp(1.0, -level);
  return mean_in(level, scaled);
}

cv::Mat bent_pixels(const Layer& layer, double max_bend_codes) {
  ENSURE(layer.color.type() == CV_32FC4 && layer.coverage.type() == CV_32FC1 && layer.color.isContinuous());
  cv::Mat bent = cv::Mat::zeros(layer.coverage.size(), CV_8UC1);
  const cv::Mat codes = codes_of(layer.color);
  const auto limit = static_cast<float>(max_bend_codes);
  std::vector<float> bends(static_cast<std::size_t>(codes.cols), 0.0F);
  for (int j = 1; j + 1 < bent.rows; ++j) {
    find_bends(codes, j, bends);
    const float* const above = layer.coverage.ptr<float>(j - 1);
    const float* const here = layer.coverage.ptr<float>(j);
    const float* const below = layer.coverage.ptr<float>(j + 1);
    unsigned char* const to = bent.ptr<unsigned char>(j);
    for (int i = 1; i + 1 < bent.cols; ++i) {
      const float* const four = &bends[static_cast<std::size_t>(kChannels) * static_cast<std::size_t>(i)];
      const float most = std::max(std::max(four[0], four[1]), std::max(four[2], four[3]));
      const bool is_even =
          here[i - 1] == here[i] && here[i + 1] == here[i] && above[i] == here[i] && below[i] == here[i];
      to[i] = is_even && most <= limit ? 0 : 255;
    }
  }
  return bent;
}

cv::Rect cells_touched(const CoarseView& view, const Quadrilateral& corners) {
  const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), glm::min(corners[2], corners[3]));
  const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), glm::max(corners[2], corners[3]));
  const cv::Size count = view.is_rough.size();
  const double cells_a_pixel = 1.0 / view.step;
  // AreaReader widens what is smaller than a pixel by up to a half on each side.
  const double margin = high.x - low.x < 2 || high.y - low.y < 2 ? 0.5 : 0.0;
  const glm::dvec2 first = (low - margin) * cells_a_pixel;
  const glm::dvec2 last = (high + margin) * cells_a_pixel;
  if (!(last.x > 0 && last.y > 0 && first.x < count.width && first.y < count.height)) return {};  // or no number
  const cv::Point from(static_cast<int>(std::max(first.x, 0.0)), static_cast<int>(std::max(first.y, 0.0)));
  const cv::Point end(std::min(static_cast<int>(std::min(last.x, 1e9)) + 1, count.width),
                      std::min(static_cast<int>(std::min(last.y, 1e9)) + 1, count.height));
  return {from, end};
}

bool is_rough_in(const CoarseView& view, const cv::Rect& cells) {
  unsigned char any = 0;
  for (int j = cells.y; j < cells.y + cells.height; ++j) {
    const unsigned char* const row = view.is_rough.ptr<unsigned char>(j);
    for (int i = cells.x; i < cells.x + cells.width; ++i) any |= row[i];
  }
  return any != 0;
}

AreaMean interpolated(const CoarseView& view, const Quadrilateral& corners) {
  using Channels [[gnu::vector_size(kChannels * sizeof(float))]] = float;
  const glm::dvec2 middle = (corners[0] + corners[1] + corners[2] + corners[3]) * (0.25 / view.step) - 0.5;
  const cv::Size size = view.layer.coverage.size();
  const auto x = static_cast<float>(std::clamp(middle.x, 0.0, double(size.width - 1)));
  const auto y = static_cast<float>(std::clamp(middle.y, 0.0, double(size.height - 1)));
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const int right = std::min(left + 1, size.width - 1);
  const int bottom = std::min(top + 1, size.height - 1);
  const auto at = [&](int row, int column) {
    Channels color;
    std::memcpy(&color, view.layer.color.ptr<cv::Vec4f>(row)[column].val, sizeof(color));
    return color;
  };
  const float across = x - static_cast<float>(left);
  const Channels above = at(top, left) + across * (at(top, right) - at(top, left));
  const Channels below = at(bottom, left) + across * (at(bottom, right) - at(bottom, left));
  const Channels mean = above + (y - static_cast<float>(top)) * (below - above);
  return {{mean[0], mean[1], mean[2], mean[3]}, view.layer.coverage.ptr<float>(top)[left]};  // coverage is even there
}

}  // namespace sigs
