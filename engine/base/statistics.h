// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace sigs {

// The value below which a share, 0 to 1, of the samples lies: linear between the two nearest sorted samples, so that
// the smallest is the quantile 0, the largest 1, and the median of an even number the mean of the middle two (Hyndman
// and Fan's type 7, as NumPy has it). NaN of no samples. The samples must not be NaN; a share outside of 0 to 1 is
// clamped.
template <class Number>
[[nodiscard]] double quantile(std::vector<Number> samples, double share) {
  if (samples.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(samples.size() - 1);
  const auto below = samples.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(samples.begin(), below, samples.end());
  const double part = at - std::floor(at), low = static_cast<double>(*below);
  if (part == 0) return low;
  return low + part * (static_cast<double>(*std::min_element(below + 1, samples.end())) - low);
}

// The quantile 0.5.
template <class Number>
[[nodiscard]] double median(std::vector<Number> samples) {
  return quantile(std::move(samples), 0.5);
}

// The arithmetic mean; NaN of no samples.
[[nodiscard]] inline double mean(std::span<const double> samples) {
  double sum = 0;
  for (const double sample : samples) sum += sample;
  return samples.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(samples.size());
}

// The standard deviation about the mean, divided by the number of samples; NaN of no samples.
[[nodiscard]] inline double standard_deviation(std::span<const double> samples) {
  const double middle = mean(samples);
  double squares = 0;
  for (const double sample : samples) squares += (sample - middle) * (sample - middle);
  return std::sqrt(squares / static_cast<double>(samples.size()));
}

// The standard deviation of a Gaussian with the samples' median absolute deviation about their median, which outliers
// do not move; NaN of no samples.
template <class Number>
[[nodiscard]] double robust_standard_deviation(const std::vector<Number>& samples) {
  const double middle = median(samples);
  std::vector<double> off;
  off.reserve(samples.size());
  for (const Number sample : samples) off.push_back(std::abs(static_cast<double>(sample) - middle));
  return 1.4826 * median(std::move(off));
}

}  // namespace sigs
