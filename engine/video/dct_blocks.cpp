// SPDX-License-Identifier: MIT
#include "video/dct_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/ensure.h"

namespace sigs {
namespace {

constexpr int kSide = 8;

using DctBlock = std::array<double, 64>;  // row by row

// Row k: the k-th basis function of the orthonormal cosine transform (T.81, A.3.3).
const DctBlock& basis() {
  static const DctBlock functions = [] {
    DctBlock made{};
    for (int k = 0; k < kSide; ++k)
      for (int i = 0; i < kSide; ++i)
        made[static_cast<std::size_t>(kSide * k + i)] =
            (k == 0 ? std::sqrt(0.125) : 0.5) * std::cos((2 * i + 1) * k * std::numbers::pi / 16);
    return made;
  }();
  return functions;
}

// The product of two 8x8 matrices, either of them transposed.
template <bool kFirstTransposed, bool kSecondTransposed>
DctBlock product(const DctBlock& a, const DctBlock& b) {
  DctBlock c{};
  for (std::size_t row = 0; row < kSide; ++row)
    for (std::size_t i = 0; i < kSide; ++i) {
      const double factor = a[kFirstTransposed ? kSide * i + row : kSide * row + i];
      for (std::size_t column = 0; column < kSide; ++column)
        c[kSide * row + column] += factor * b[kSecondTransposed ? kSide * column + i : kSide * i + column];
    }
  return c;
}

DctBlock transformed(const DctBlock& samples) {
  return product<false, true>(product<false, false>(basis(), samples), basis());
}

DctBlock inverse_transformed(const DctBlock& coefficients) {
  return product<false, false>(product<true, false>(basis(), coefficients), basis());
}

// Calls change(block of plane, block of other, upper left corner) for each block in which the two planes differ.
template <class Change>
void for_each_difference(cv::Mat& plane, const cv::Mat& other, const Change& change) {
  ENSURE(plane.size() == other.size() && plane.rows % kSide == 0 && plane.cols % kSide == 0);
  for (int y = 0; y < plane.rows; y += kSide)
    for (int x = 0; x < plane.cols; x += kSide) {
      const cv::Rect at(x, y, kSide, kSide);
      cv::Mat block = plane(at);
      const cv::Mat beside = other(at);
      if (cv::norm(block, beside, cv::NORM_INF) > 0) change(block, beside, at.tl());
    }
}

// samples[i] of the block less subtrahend(i, sample).
template <class Subtrahend>
DctBlock difference(const cv::Mat& block, const Subtrahend& subtrahend) {
  DctBlock samples{};
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      samples[static_cast<std::size_t>(kSide * j + i)] = block.at<uchar>(j, i) - subtrahend(j, i);
  return samples;
}

template <class Addend>
void put(cv::Mat& block, const DctBlock& samples, const Addend& addend) {
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      block.at<uchar>(j, i) = cv::saturate_cast<uchar>(samples[static_cast<std::size_t>(kSide * j + i)] + addend(j, i));
}

// H.263, 6.2: a level l stands for (|l| + 1/2) steps.
double mpeg_decoded(double coefficient, double step) {
  const double level = std::floor(std::abs(coefficient) / step - 0.25);
  return level < 1 ? 0 : std::copysign((level + 0.5) * step, coefficient);
}

}  // namespace

void code_jpeg(cv::Mat& plane, const cv::Mat& before, const JpegTable& steps) {
  const auto middle = [](int, int) { return 128.0; };
  for_each_difference(plane, before, [&](cv::Mat& block, const cv::Mat&, cv::Point) {
    DctBlock coefficients = transformed(difference(block, middle));
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      const double step = std::max(1, steps[i]);
      coefficients[i] = std::round(coefficients[i] / step) * step;
    }
    put(block, inverse_transformed(coefficients), middle);
  });
}

void code_mpeg(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& step, cv::Size macroblock_px) {
  for_each_difference(plane, predicted, [&](cv::Mat& block, const cv::Mat& prediction, cv::Point at) {
    const auto predicted_sample = [&](int j, int i) { return static_cast<double>(prediction.at<uchar>(j, i)); };
    const double here = std::max<short>(1, step.at<short>(at.y / macroblock_px.height, at.x / macroblock_px.width));
    DctBlock coefficients = transformed(difference(block, predicted_sample));
    for (double& coefficient : coefficients) coefficient = mpeg_decoded(coefficient, here);
    put(block, inverse_transformed(coefficients), predicted_sample);
  });
}

}  // namespace sigs
