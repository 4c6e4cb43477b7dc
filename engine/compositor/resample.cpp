// SPDX-License-Identifier: MIT
#include "compositor/resample.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ensure.h"

namespace sigs {

namespace {

double gaussian(double x, double sigma) {
  return std::exp(-0.5 * (x / sigma) * (x / sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
}

// The weight of a cell under the truncated Gaussian, relative to the position where it is sampled.
double sample_weight(double low, double high, double sigma, double radius) {
  low = std::max(low, -radius);
  high = std::min(high, radius);
  return high > low ? (high - low) * gaussian(0.5 * (low + high), sigma) : 0.0;
}

// Converted only where it is small enough for an int.
int index_within(double index, int count) {
  return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(count)));
}

// BORDER_REFLECT_101: ... 2 1 | 0 1 2 ... n-1 | n-2 ...
int mirrored(long long index, int count) {
  if (count == 1) return 0;
  const long long period = 2LL * (count - 1);
  const long long within = ((index % period) + period) % period;
  return static_cast<int>(std::min(within, period - within));
}

Taps mirrored_taps_at(double place, int size_px, double sigma_px, double radius_px) {
  const auto low = static_cast<long long>(std::ceil(place - radius_px));
  const auto high = static_cast<long long>(std::floor(place + radius_px));
  std::vector<double> folded(static_cast<std::size_t>(size_px), 0.0);
  double sum = 0;
  for (long long i = low; i <= high; ++i) {
    const double weight = gaussian(static_cast<double>(i) - place, sigma_px);
    folded[static_cast<std::size_t>(mirrored(i, size_px))] += weight;
    sum += weight;
  }
  const auto is_used = [](double weight) { return weight != 0; };
  const auto begin = std::find_if(folded.begin(), folded.end(), is_used);
  const auto end = std::find_if(folded.rbegin(), folded.rend(), is_used).base();
  Taps taps{.first = static_cast<int>(begin - folded.begin())};
  for (auto weight = begin; weight < end; ++weight) taps.weights.push_back(static_cast<float>(*weight / sum));
  return taps;
}

cv::Mat with_rows(const cv::Mat& image, std::span<const Taps> rows) {
  cv::Mat out = cv::Mat::zeros(static_cast<int>(rows.size()), image.cols, image.type());
  const int width = image.cols * image.channels();
  for (int y = 0; y < out.rows; ++y) {
    const Taps& taps = rows[static_cast<std::size_t>(y)];
    float* const sum = out.ptr<float>(y);
    for (std::size_t t = 0; t < taps.weights.size(); ++t) {
      const float* const row = image.ptr<float>(taps.first + static_cast<int>(t));
      const float weight = taps.weights[t];
      for (int i = 0; i < width; ++i) sum[i] += weight * row[i];
    }
  }
  return out;
}

template <int channels>
cv::Mat with_columns(const cv::Mat& image, std::span<const Taps> columns) {
  cv::Mat out(image.rows, static_cast<int>(columns.size()), image.type());
  for (int y = 0; y < out.rows; ++y) {
    const float* const row = image.ptr<float>(y);
    float* to = out.ptr<float>(y);
    for (const Taps& taps : columns) {
      float sum[channels] = {};
      const float* from = row + static_cast<std::ptrdiff_t>(taps.first) * channels;
      for (const float weight : taps.weights)
        for (int c = 0; c < channels; ++c) sum[c] += weight * *from++;
      for (int c = 0; c < channels; ++c) *to++ = sum[c];
    }
  }
  return out;
}

}  // namespace

std::vector<Taps> gaussian_taps(const UniformGrid& out, const UniformGrid& in, double sigma_px, double radius_px) {
  ENSURE(sigma_px > 0 && radius_px > 0);
  const double whole = std::erf(radius_px / (sigma_px * std::numbers::sqrt2));
  std::vector<Taps> all;
  for (int o = 0; o < out.count; ++o) {
    const double place = out.at(o);
    const int low = index_within(std::floor((place - radius_px - in.first) / in.step), in.count);
    const int high = index_within(std::ceil((place + radius_px - in.first) / in.step) + 1, in.count);
    Taps taps{.first = low};
    for (int i = low; i < high; ++i) {
      const double low_edge = in.at(i) - 0.5 * in.step - place;
      taps.weights.push_back(
          static_cast<float>(sample_weight(low_edge, low_edge + in.step, sigma_px, radius_px) / whole));
    }
    all.push_back(std::move(taps));
  }
  return all;
}

std::vector<Taps> mirrored_gaussian_taps(const UniformGrid& out, int size_px, double sigma_px, double radius_px) {
  ENSURE(sigma_px > 0 && radius_px >= 0.5 && radius_px < 1e9 && size_px > 0);
  std::vector<Taps> all;
  for (int o = 0; o < out.count; ++o) all.push_back(mirrored_taps_at(out.at(o), size_px, sigma_px, radius_px));
  return all;
}

UniformGrid uniform_grid_for(int first_px, int size_px, double step) {
  ENSURE(step >= 1 && size_px > 0);
  return {.first = first_px - step, .step = step, .count = static_cast<int>(std::ceil((size_px - 1) / step)) + 4};
}

std::vector<Taps> spline_taps(int first_px, int size_px, const UniformGrid& in) {
  std::vector<Taps> all;
  for (int x = first_px; x < first_px + size_px; ++x) {
    const double place = (x - in.first) / in.step;
    ENSURE(place > 0.5 && place < in.count - 1.5);
    const int before = std::clamp(static_cast<int>(place), 1, in.count - 3);
    const double t = std::clamp(place - before, 0.0, 1.0);  // rounding may put the first slightly before its position
    const double r = 1 - t;
    all.push_back(
        {.first = before - 1,
         .weights = {static_cast<float>(r * r * r / 6), static_cast<float>((3 * t - 6) * t * t / 6 + 4. / 6),
                     static_cast<float>((3 * r - 6) * r * r / 6 + 4. / 6), static_cast<float>(t * t * t / 6)}});
  }
  return all;
}

double splined_variance(double step) {
  return step * step / 3;  // four boxes convolved, a twelfth each
}

cv::Mat resampled(const cv::Mat& image, std::span<const Taps> rows, std::span<const Taps> columns) {
  ENSURE(image.type() == CV_32FC1 || image.type() == CV_32FC3 || image.type() == CV_32FC4);
  const cv::Mat by_rows = with_rows(image, rows);
  if (image.channels() == 1) return with_columns<1>(by_rows, columns);
  return image.channels() == 3 ? with_columns<3>(by_rows, columns) : with_columns<4>(by_rows, columns);
}

}  // namespace sigs
