// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>
#include <vector>

namespace sigs::flights {

// Binary places of the fixed-point coordinates that OpenCV's drawing functions take.
inline constexpr int kDrawingShift = 4;

// Four channels at once, as codes 0..255.
using Codes = cv::v_float32x4;

[[nodiscard]] inline Codes mix(const Codes& a, const Codes& b, float share) {
  return a + (b - a) * cv::v_setall_f32(share);
}

// A square image of the plane that repeats in both directions, with coarser copies of itself. Row is world X (north),
// column is world Y (east).
class Mosaic {
 public:
  // finest: CV_8UC4, its side a power of two; cell_m: side of one of its cells.
  Mosaic(const cv::Mat& finest, double cell_m);

  [[nodiscard]] double cell_m() const { return cell_m_; }

  // At a place of the world, in the copy whose cells are 2^level wide (clamped to those there are).
  [[nodiscard]] Codes at(float x_m, float y_m, int level) const {
    const Copy& copy = copies_[static_cast<std::size_t>(std::clamp(level, 0, int(copies_.size()) - 1))];
    const float row = x_m * copy.per_m - 0.5F, column = y_m * copy.per_m - 0.5F;
    const int i = cvFloor(row), j = cvFloor(column);
    const float down = row - static_cast<float>(i), right = column - static_cast<float>(j);
    const int left = j & copy.wrap, next = (j + 1) & copy.wrap;
    const cv::Vec4b* upper = copy.cells + std::ptrdiff_t(i & copy.wrap) * (copy.wrap + 1);
    const cv::Vec4b* lower = copy.cells + std::ptrdiff_t((i + 1) & copy.wrap) * (copy.wrap + 1);
    return mix(mix(codes(upper[left]), codes(upper[next]), right), mix(codes(lower[left]), codes(lower[next]), right),
               down);
  }

  // The same between two copies.
  [[nodiscard]] Codes between(float x_m, float y_m, float level) const {
    const float clamped = std::clamp(level, 0.0F, static_cast<float>(copies_.size()) - 1.001F);
    const int lower = static_cast<int>(clamped);
    return mix(at(x_m, y_m, lower), at(x_m, y_m, lower + 1), clamped - static_cast<float>(lower));
  }

 private:
  struct Copy {
    cv::Mat image;
    const cv::Vec4b* cells = nullptr;  // of image, row after row
    int wrap = 0;                      // cells along a side, less one
    float per_m = 1;
  };
  [[nodiscard]] static Codes codes(const cv::Vec4b& cell) {
    return cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(cell.val)));
  }

  double cell_m_;
  std::vector<Copy> copies_;
};

// Smooth noise that repeats after size cells: CV_32FC1, -1..1. coarsest: cells of the first octave's grid along a side;
// each further octave is twice as fine and `fade` as strong. Powers of two.
[[nodiscard]] cv::Mat tiled_noise(int size, int coarsest, int octaves, double fade, std::uint32_t seed);

}  // namespace sigs::flights
