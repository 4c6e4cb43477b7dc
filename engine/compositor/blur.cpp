// SPDX-License-Identifier: MIT
#include "compositor/blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "compositor/resample.h"

namespace sigs {

namespace {

constexpr double kCellsPerSigma = 8;
constexpr double kPlacesPerSigma = 4;

// Cells by their middles, in the picture's pixels.
Lattice middles(int first, int count, double cell_px) {
  return {.first = (first + 0.5) * cell_px - 0.5, .step = cell_px, .count = count};
}

// The number of the cell that holds a pixel, also left of the picture.
int cell_of(int pixel, int cell_px) {
  return pixel >= 0 ? pixel / cell_px : -((cell_px - 1 - pixel) / cell_px);
}

// Variance of weights exp(-n^2 log_ratio) on all whole numbers n; up to 1, a dozen of them say it all.
double variance_of_samples(double log_ratio) {
  double sum = 0.5;
  double moment = 0;
  for (int n = 1; n <= 12; ++n) {
    const double weight = std::exp(-n * n * log_ratio);
    sum += weight;
    moment += n * n * weight;
  }
  return moment / sum;
}

// For the weights exp(-n^2 log_ratio) of the pixels n away whose variance is sigma^2. From one pixel on these are the
// Gaussian's own samples (to seven digits). A narrower Gaussian falls between the samples and would hardly blur at all:
// the one that is sampled has to be wider.
double log_ratio_for(double sigma_px) {
  if (sigma_px >= 1) return 0.5 / (sigma_px * sigma_px);
  constexpr int kHalvings = 60;
  double low = 0.5;
  double high = 100;  // next to no blur
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (variance_of_samples(middle) > sigma_px * sigma_px ? low : high) = middle;
  }
  return low;
}

// One axis of the kernel, 2 reach + 1 samples that sum to one. What could not change any 8-bit sample is 0: a blur of
// next to nothing touches no neighbour.
cv::Mat sampled_gaussian(double sigma_px, int reach) {
  constexpr double kLeast = 1e-6;
  const double log_ratio = log_ratio_for(sigma_px);
  cv::Mat kernel(2 * reach + 1, 1, CV_64FC1);
  for (int n = -reach; n <= reach; ++n) {
    const double weight = std::exp(-n * n * log_ratio);
    kernel.at<double>(n + reach) = weight < kLeast ? 0 : weight;
  }
  kernel /= cv::sum(kernel)[0];
  kernel.convertTo(kernel, CV_32F);
  return kernel;
}

cv::Rect grown(const cv::Rect& rect, int by_px) {
  return {rect.x - by_px, rect.y - by_px, rect.width + 2 * by_px, rect.height + 2 * by_px};
}

cv::Mat with_border(const cv::Mat& image, int width_px) {
  cv::Mat out;
  cv::copyMakeBorder(image, out, width_px, width_px, width_px, width_px, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return out;
}

}  // namespace

int blur_reach_px(double sigma_px) {
  ENSURE(sigma_px >= 0 && sigma_px < 1e8);
  return static_cast<int>(std::ceil(3 * sigma_px));
}

Layer blurred(const Layer& layer, double sigma_px) {
  const int reach = blur_reach_px(sigma_px);
  if (reach == 0 || layer.empty()) return layer;
  Layer out{grown(layer.rect, reach), with_border(layer.color, reach), with_border(layer.coverage, reach)};
  const cv::Mat kernel = sampled_gaussian(sigma_px, reach);
  cv::sepFilter2D(out.color, out.color, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_CONSTANT);
  return out;
}

double largest_cell_px(double sigma_px) {
  return std::max(1.0, sigma_px / kCellsPerSigma);
}

Layer blurred_from_cells(const Layer& cells, double cell_px, double sigma_px, const cv::Rect& target) {
  ENSURE(sigma_px >= kSigmaOfCells_px && cell_px >= 1 && cell_px <= largest_cell_px(sigma_px));
  if (cells.empty() || target.empty()) return {};
  const double step_px = sigma_px / kPlacesPerSigma;
  // A cell moves its pixels to its middle, and the spline spreads: the kernel between them gives way by that much.
  const double moved = (cell_px * cell_px - 1) / 12;
  const double kernel_px = std::sqrt(sigma_px * sigma_px - moved - splined_variance(step_px));
  const double reach_px = std::ceil(3 * sigma_px) + 0.5;  // as far as blurred() reaches, in whole pixels
  const Lattice down = lattice_for(target.y, target.height, step_px);
  const Lattice across = lattice_for(target.x, target.width, step_px);
  const cv::Mat places = resampled(
      cells.color, gaussian_taps(down, middles(cells.rect.y, cells.rect.height, cell_px), kernel_px, reach_px),
      gaussian_taps(across, middles(cells.rect.x, cells.rect.width, cell_px), kernel_px, reach_px));
  return {target,
          resampled(places, spline_taps(target.y, target.height, down), spline_taps(target.x, target.width, across)),
          cv::Mat::zeros(target.size(), CV_32FC1)};
}

Layer in_cells(const Layer& layer, int cell_px) {
  if (layer.empty()) return {};
  const cv::Point first(cell_of(layer.rect.x, cell_px), cell_of(layer.rect.y, cell_px));
  const cv::Point last(cell_of(layer.rect.br().x - 1, cell_px), cell_of(layer.rect.br().y - 1, cell_px));
  const cv::Rect cells(first, last + cv::Point(1, 1));
  const cv::Rect pixels(cells.tl() * cell_px, cells.size() * cell_px);
  cv::Mat color = cv::Mat::zeros(pixels.size(), CV_32FC4);
  layer.color.copyTo(color(layer.rect - pixels.tl()));
  cv::resize(color, color, cells.size(), 0, 0, cv::INTER_AREA);
  return {cells, color, cv::Mat::zeros(cells.size(), CV_32FC1)};
}

double most_after_blur(const Layer& cells, double cell_px, double sigma_px) {
  if (cells.empty()) return 0;
  const cv::Scalar sum = cv::sum(cells.color);
  const double most = std::max({sum[0], sum[1], sum[2], sum[3]}) * cell_px * cell_px;
  constexpr double kCut =
      1.03;  // the cut kernel is higher by 1 / 0.9973^2, and by 1 / 48 as it gives way to the spline
  return kCut * most / (2 * std::numbers::pi * sigma_px * sigma_px);
}

}  // namespace sigs
