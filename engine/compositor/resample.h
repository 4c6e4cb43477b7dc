// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace sigs {

// One sample of the output along an axis: a weighted sum of neighbouring samples of the input.
struct Taps {
  int first = 0;
  std::vector<float> weights;  // empty: no input sample has weight in it
};

// Evenly spaced positions along an axis, px.
struct UniformGrid {
  double first = 0;
  double step = 1;
  int count = 0;

  [[nodiscard]] double at(int i) const { return first + i * step; }
};

// Gaussian truncated at radius_px, sampled at the positions of `out`. The input's samples are squares that touch each
// other; one that the cut halves counts by half. Weights sum to one over an input without borders; beyond its borders
// is nothing.
[[nodiscard]] std::vector<Taps> gaussian_taps(const UniformGrid& out, const UniformGrid& in, double sigma_px,
                                              double radius_px);

// The same for an input of size_px pixels that goes on beyond its borders as OpenCV's BORDER_REFLECT_101.
[[nodiscard]] std::vector<Taps> mirrored_gaussian_taps(const UniformGrid& out, int size_px, double sigma_px,
                                                       double radius_px);

// Places of `step` that serve to rebuild the pixels [first_px, first_px + size_px).
[[nodiscard]] UniformGrid uniform_grid_for(int first_px, int size_px, double step);

// Rebuilds these pixels by the cubic B-spline: smooth, never beyond its inputs, and without their error in exchange for
// spreading them by splined_variance(step).
[[nodiscard]] std::vector<Taps> spline_taps(int first_px, int size_px, const UniformGrid& in);
[[nodiscard]] double splined_variance(double step);

// Each axis by its own taps. image is CV_32FC1, CV_32FC3 or CV_32FC4.
[[nodiscard]] cv::Mat resampled(const cv::Mat& image, std::span<const Taps> rows, std::span<const Taps> columns);

}  // namespace sigs
