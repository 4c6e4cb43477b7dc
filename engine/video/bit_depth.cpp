// SPDX-License-Identifier: MIT
#include "video/bit_depth.h"

#include <algorithm>
#include <vector>

#include "base/ensure.h"

namespace sigs {

namespace {

// Codes of one depth by those of another.
struct DepthChange {
  int from = 8;
  int to = 8;
  bool is_full_range = false;
  bool is_chroma = false;
};

template <class To>
std::vector<To> code_table(const DepthChange& change) {
  const double from_top = max_code(change.from);
  const double to_top = max_code(change.to);
  const double from_middle = change.is_chroma ? 1 << (change.from - 1) : 0;
  const double to_middle = change.is_chroma ? 1 << (change.to - 1) : 0;
  const double scale = change.is_full_range ? to_top / from_top : double(1 << change.to) / double(1 << change.from);
  std::vector<To> table(std::size_t{1} << change.from);
  for (std::size_t code = 0; code < table.size(); ++code) {
    const double value = (static_cast<double>(code) - from_middle) * scale + to_middle;
    table[code] = static_cast<To>(std::clamp(value + 0.5, 0.0, to_top));
  }
  return table;
}

template <class From, class To>
cv::Mat replaced(const cv::Mat& plane, const DepthChange& change) {
  const std::vector<To> table = code_table<To>(change);
  const std::size_t mask = table.size() - 1;  // codes beyond the depth do not exist; nothing is read beyond the table
  cv::Mat out(plane.size(), plane_type(change.to));
  for (int y = 0; y < plane.rows; ++y)
    std::transform(plane.ptr<From>(y), plane.ptr<From>(y) + plane.cols, out.ptr<To>(y),
                   [&](From code) { return table[code & mask]; });
  return out;
}

}  // namespace

Frame with_bit_depth(const Frame& frame, int bit_depth) {
  ENSURE(bit_depth >= 8 && bit_depth <= 16);
  if (frame.bit_depth == bit_depth) return frame;
  Frame out = frame;
  out.bit_depth = bit_depth;
  const bool is_rgb = frame.layout == PixelLayout::rgb;
  for (int i = 0; i < frame.plane_count(); ++i) {
    const DepthChange change{.from = frame.bit_depth,
                             .to = bit_depth,
                             .is_full_range = is_rgb || frame.color.range == ColorRange::full,
                             .is_chroma = i > 0 && !is_rgb};
    const auto index = static_cast<std::size_t>(i);
    out.planes[index] = with_sample_type(frame.bit_depth, [&](auto from) {
      return with_sample_type(
          bit_depth, [&](auto to) { return replaced<decltype(from), decltype(to)>(frame.planes[index], change); });
    });
  }
  return out;
}

}  // namespace sigs
