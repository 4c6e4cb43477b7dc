// SPDX-License-Identifier: MIT
#include "appearance/codec.h"

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "base/statistics.h"

namespace sigs {
namespace {

constexpr int kBlock = 8;

// The standard deviation that a few frames let expect of all: by their number less one; 0 of one frame.
double sample_deviation(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  return values.size() < 2 ? 0 : standard_deviation(values) * std::sqrt(count / (count - 1));
}

// The mean of what frames have shown, with the standard deviation of that mean.
Estimate mean_estimate(const std::vector<double>& values, const char* why_not) {
  if (values.empty()) return {.why = why_not};
  const double sd = sample_deviation(values) / std::sqrt(static_cast<double>(values.size()));
  return {.value = mean(values), .sd = sd, .is_known = true};
}

// Sums and numbers of absolute steps between neighbours: of those across an edge of the grid, and of all others.
struct Steps {
  double across = 0, within = 0;
  double across_count = 0, within_count = 0;

  void add(double sum, double count, bool is_across) {
    (is_across ? across : within) += sum;
    (is_across ? across_count : within_count) += count;
  }
};

// Steps that a codec would never make are edges of what is in the image; they do not count.
constexpr int kMaxStep = 24;

void add_steps_across(const cv::Mat& luma, int origin, Steps& steps) {
  std::vector<unsigned> sums(static_cast<std::size_t>(luma.cols)), counts(sums.size());
  for (int y = 0; y < luma.rows; ++y) {
    const uchar* const row = luma.ptr<uchar>(y);
    for (std::size_t x = 1; x < sums.size(); ++x) {
      const auto step = static_cast<unsigned>(std::abs(row[x] - row[x - 1]));
      sums[x] += step <= kMaxStep ? step : 0;
      counts[x] += step <= kMaxStep ? 1 : 0;
    }
  }
  for (int x = 1; x < luma.cols; ++x)
    steps.add(sums[static_cast<std::size_t>(x)], counts[static_cast<std::size_t>(x)], (x - origin) % kBlock == 0);
}

void add_steps_down(const cv::Mat& luma, int origin, Steps& steps) {
  for (int y = 1; y < luma.rows; ++y) {
    const uchar* const above = luma.ptr<uchar>(y - 1);
    const uchar* const row = luma.ptr<uchar>(y);
    unsigned sum = 0, count = 0;
    for (int x = 0; x < luma.cols; ++x) {
      const auto step = static_cast<unsigned>(std::abs(row[x] - above[x]));
      sum += step <= kMaxStep ? step : 0;
      count += step <= kMaxStep ? 1 : 0;
    }
    steps.add(sum, count, (y - origin) % kBlock == 0);
  }
}

// By how much a sample differs from the mean of its left and right neighbour, twice.
int roughness(const uchar* row, int x) {
  return std::abs(2 * row[x] - row[x - 1] - row[x + 1]);
}

// 255 at pixels without a strong edge, 0 at those with one. At the image's sides only one direction is looked at.
cv::Mat free_of_edges(const cv::Mat& luma) {
  constexpr int kEdge = 30;  // code values between the neighbours on either side
  cv::Mat is_free(luma.size(), CV_8UC1);
  for (int y = 0; y < luma.rows; ++y) {
    const bool is_inside = y > 0 && y + 1 < luma.rows;
    const uchar* const above = luma.ptr<uchar>(is_inside ? y - 1 : y);
    const uchar* const below = luma.ptr<uchar>(is_inside ? y + 1 : y);
    const uchar* const row = luma.ptr<uchar>(y);
    uchar* const out = is_free.ptr<uchar>(y);
    for (int x = 0; x < luma.cols; ++x) {
      const int left = x > 0 && x + 1 < luma.cols ? x - 1 : x;
      const int across = row[x + (x - left)] - row[left];
      const int down = below[x] - above[x];
      out[x] = across * across + down * down < kEdge * kEdge ? 255 : 0;
    }
  }
  return is_free;
}

}  // namespace

void CodecEstimator::add(const Frame& frame, bool look_for_traces) {
  ++frames_;
  cv::Point origin_px;
  if (frame.quantisers != nullptr) {
    codec_ = frame.quantisers->codec;
    kind_ = frame.quantisers->kind;
    predicts_ |= frame.quantisers->is_predicted();
    origin_px = frame.quantisers->origin_px;
    means_.push_back(frame.quantisers->mean);
  }
  if (!look_for_traces) return;
  add_block_grid(frame.planes[0], origin_px);
  add_ringing(frame.planes[0]);
}

void CodecEstimator::add_block_grid(const cv::Mat& luma, const cv::Point& origin_px) {
  Steps steps;
  add_steps_across(luma, origin_px.x, steps);
  add_steps_down(luma, origin_px.y, steps);
  constexpr double kMinSteps = 1000;
  if (steps.across_count < kMinSteps || steps.within_count < kMinSteps || steps.within == 0) return;
  block_grids_.push_back(steps.across / steps.across_count / (steps.within / steps.within_count) - 1);
}

// Samples at three to seven pixels from a strong edge, where a transform of 8x8 rings, against those far from all.
void CodecEstimator::add_ringing(const cv::Mat& luma) {
  constexpr float kNear_px = 3;
  constexpr float kBeside_px = 7;
  constexpr float kFar_px = 20;
  constexpr int kMaxRough = 24;  // beyond: detail of what is in the image
  constexpr double kMinSamples = 500;
  cv::Mat distance_px;
  cv::distanceTransform(free_of_edges(luma), distance_px, cv::DIST_L2, 3);
  double beside = 0, beside_count = 0, away = 0, away_count = 0;
  for (int y = 0; y < luma.rows; ++y) {
    const uchar* const row = luma.ptr<uchar>(y);
    const float* const distance = distance_px.ptr<float>(y);
    for (int x = 1; x + 1 < luma.cols; ++x) {
      const int rough = roughness(row, x);
      if (rough > kMaxRough) continue;
      if (distance[x] >= kNear_px && distance[x] <= kBeside_px) beside += rough, ++beside_count;
      if (distance[x] >= kFar_px) away += rough, ++away_count;
    }
  }
  if (beside_count < kMinSamples || away_count < kMinSamples) return;
  ringings_.push_back((beside / beside_count - away / away_count) / 2);
}

CodecEstimate CodecEstimator::finish() const {
  CodecEstimate found{.codec = codec_, .kind = kind_, .predicts = predicts_};
  if (!means_.empty())
    found.quantiser = {.value = mean(means_), .sd = sample_deviation(means_), .is_known = true};
  else
    found.quantiser = {.value = kDefaultQp,
                       .why = frames_ == 0 ? "no frames" : "the footage's stream does not state its quantisers"};
  found.block_grid = mean_estimate(block_grids_, "no gradients to see a grid in");
  found.ringing = mean_estimate(ringings_, "no strong edge, or nothing but edges");
  return found;
}

}  // namespace sigs
