// SPDX-License-Identifier: MIT
#include "appearance/noise_blocks.h"

#include <algorithm>
#include <array>

#include "video/luma_stream.h"

namespace sigs {

namespace {

constexpr int kMostBlocks = 6000;  // of a frame

template <int n>
using Rest = std::array<float, n * n>;

struct Plane {
  float level = 0, slope_x = 0, slope_y = 0;
};

// A block less its plane. Centred coordinates make level and slopes independent of each other.
template <int n>
Plane take_plane(const cv::Mat& image, cv::Point corner, Rest<n>& rest) {
  constexpr float kMiddle = 0.5F * (n - 1);
  float sum = 0, sum_x = 0, sum_y = 0;
  for (int y = 0; y < n; ++y) {
    const uchar* const row = image.ptr<uchar>(corner.y + y) + corner.x;
    float row_sum = 0;
    for (int x = 0; x < n; ++x) {
      row_sum += row[x];
      sum_x += (static_cast<float>(x) - kMiddle) * row[x];
    }
    sum += row_sum;
    sum_y += (static_cast<float>(y) - kMiddle) * row_sum;
  }
  constexpr float kSquares = n * n * (n * n - 1) / 12.0F;  // sum of squares of either coordinate over the block
  const Plane plane{sum / (n * n), sum_x / kSquares, sum_y / kSquares};
  for (int y = 0; y < n; ++y) {
    const uchar* const row = image.ptr<uchar>(corner.y + y) + corner.x;
    const float start = plane.level + plane.slope_y * (static_cast<float>(y) - kMiddle) - plane.slope_x * kMiddle;
    for (int x = 0; x < n; ++x) rest[y * n + x] = row[x] - start - plane.slope_x * static_cast<float>(x);
  }
  return plane;
}

template <int n>
double covariance_of(const Rest<n>& a, const Rest<n>& b) {
  float sum = 0;
  for (int i = 0; i < n * n; ++i) sum += a[i] * b[i];
  return sum / (n * n - 3);
}

double neighbours_of(const Rest<kNoiseBlock_px>& rest) {
  constexpr int n = kNoiseBlock_px;
  float across = 0, down = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x + 1 < n; ++x) across += rest[y * n + x] * rest[y * n + x + 1];
  for (int i = 0; i + n < n * n; ++i) down += rest[i] * rest[i + n];
  return (across + down) / (2 * n * (n - 1));
}

bool is_clipped(const cv::Mat& image, cv::Point corner, int lowest, int highest) {
  int clipped = 0;  // counted to the end, as that is faster than to stop
  for (int y = corner.y; y < corner.y + kNoiseBlock_px; ++y) {
    const uchar* const row = image.ptr<uchar>(y) + corner.x;
    for (int x = 0; x < kNoiseBlock_px; ++x) clipped += row[x] <= lowest || row[x] >= highest ? 1 : 0;
  }
  return clipped > 0;
}

double chroma_variance(const Frame& frame, cv::Point corner) {
  constexpr int n = 8;  // as many samples as in luma
  const cv::Size step = chroma_step(frame.layout);
  const cv::Point at(corner.x / step.width, corner.y / step.height);
  double sum = 0;
  for (const int plane : {1, 2}) {
    if (at.x + n > frame.planes[plane].cols || at.y + n > frame.planes[plane].rows) return -1;
    Rest<n> rest;
    take_plane<n>(frame.planes[plane], at, rest);
    sum += covariance_of<n>(rest, rest) / 2;
  }
  return sum;
}

}  // namespace

std::vector<NoiseBlock> noise_blocks(const Frame& frame, const Frame* next) {
  constexpr int n = kNoiseBlock_px;
  const cv::Mat luma = luma_of(frame);
  const cv::Mat next_luma = next == nullptr ? cv::Mat() : luma_of(*next);
  const bool is_limited = frame.layout != PixelLayout::rgb && frame.color.range == ColorRange::limited;
  const bool has_chroma = frame.layout != PixelLayout::gray && frame.layout != PixelLayout::rgb;
  const int rows = luma.rows / n, columns = luma.cols / n;
  const int every = std::max(1, rows * columns / kMostBlocks);
  std::vector<NoiseBlock> blocks;
  for (int i = 0; i < rows; i += every) {
    for (int j = 0; j < columns; ++j) {
      const cv::Point corner(j * n, i * n);
      if (is_clipped(luma, corner, is_limited ? 16 : 0, is_limited ? 235 : 255)) continue;
      Rest<n> rest;
      NoiseBlock block{.mean = take_plane<n>(luma, corner, rest).level};
      block.variance = covariance_of<n>(rest, rest);
      block.neighbours = neighbours_of(rest);
      if (!next_luma.empty()) {
        Rest<n> later;
        take_plane<n>(next_luma, corner, later);
        block.next_variance = covariance_of<n>(later, later);
        block.covariance = covariance_of<n>(rest, later);
        for (int k = 0; k < n * n; ++k) later[k] -= rest[k];
        block.change_neighbours = neighbours_of(later) / 2;
      }
      if (has_chroma) block.chroma = chroma_variance(frame, corner);
      blocks.push_back(block);
    }
  }
  return blocks;
}

}  // namespace sigs
