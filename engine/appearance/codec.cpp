// SPDX-License-Identifier: MIT
#include "appearance/codec.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace sigs {
namespace {

constexpr int kBlock = 8;

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sd_of(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

// The mean of what frames have shown, with the standard deviation of that mean.
Estimate mean_estimate(const std::vector<double>& values, const char* why_not) {
  if (values.empty()) return {.why = why_not};
  return {
      .value = mean_of(values), .sd = sd_of(values) / std::sqrt(static_cast<double>(values.size())), .is_known = true};
}

// Mean absolute steps from column to column, of those across an edge of the grid and of all others.
struct Steps {
  double across = 0;
  double within = 0;
  long long across_count = 0;
  long long within_count = 0;

  // Steps that a codec would never make are edges of what is in the image.
  void add(int step, bool is_across) {
    constexpr int kMaxStep = 24;
    if (std::abs(step) > kMaxStep) return;
    (is_across ? across : within) += std::abs(step);
    ++(is_across ? across_count : within_count);
  }
};

void add_steps(const cv::Mat& luma, int origin, Steps& steps) {
  for (int y = 0; y < luma.rows; ++y) {
    const uchar* row = luma.ptr<uchar>(y);
    for (int x = 1; x < luma.cols; ++x) steps.add(row[x] - row[x - 1], (x - origin) % kBlock == 0);
  }
}

// By how much a sample differs from the mean of its left and right neighbour.
double roughness(const uchar* row, int x) {
  return std::abs(2 * row[x] - row[x - 1] - row[x + 1]) / 2.0;
}

// 255 at pixels without a strong edge, 0 at those with one.
cv::Mat free_of_edges(const cv::Mat& luma) {
  constexpr double kEdge = 30;  // code values between the neighbours on either side
  cv::Mat across, down;
  cv::Sobel(luma, across, CV_32F, 1, 0, 1, 0.5);
  cv::Sobel(luma, down, CV_32F, 0, 1, 1, 0.5);
  cv::Mat steep;
  cv::magnitude(across, down, steep);
  return steep < kEdge / 2;
}

}  // namespace

void CodecEstimator::add(const Frame& frame) {
  ++frames_;
  cv::Point origin_px;
  if (frame.quantisers != nullptr) {
    codec_ = frame.quantisers->codec;
    kind_ = frame.quantisers->kind;
    predicts_ |= frame.quantisers->is_predicted();
    origin_px = frame.quantisers->origin_px;
    means_.push_back(frame.quantisers->mean);
  }
  add_block_grid(frame.planes[0], origin_px);
  add_ringing(frame.planes[0]);
}

void CodecEstimator::add_block_grid(const cv::Mat& luma, const cv::Point& origin_px) {
  Steps steps;
  add_steps(luma, origin_px.x, steps);
  add_steps(luma.t(), origin_px.y, steps);
  constexpr long long kMinSteps = 1000;
  if (steps.across_count < kMinSteps || steps.within_count < kMinSteps || steps.within == 0) return;
  block_grids_.push_back(steps.across / static_cast<double>(steps.across_count) /
                             (steps.within / static_cast<double>(steps.within_count)) -
                         1);
}

// Samples at three to seven pixels from a strong edge, where a transform of 8x8 rings, against those far from all.
void CodecEstimator::add_ringing(const cv::Mat& luma) {
  constexpr float kNear_px = 3;
  constexpr float kBeside_px = 7;
  constexpr float kFar_px = 20;
  constexpr double kMostRough = 12;  // beyond: detail of what is in the image
  constexpr std::size_t kMinSamples = 500;
  cv::Mat distance_px;
  cv::distanceTransform(free_of_edges(luma), distance_px, cv::DIST_L2, 3);
  std::vector<double> beside, away;
  for (int y = 0; y < luma.rows; ++y)
    for (int x = 1; x + 1 < luma.cols; ++x) {
      const float distance = distance_px.at<float>(y, x);
      const double rough = roughness(luma.ptr<uchar>(y), x);
      if (rough > kMostRough) continue;
      if (distance >= kNear_px && distance <= kBeside_px) beside.push_back(rough);
      if (distance >= kFar_px) away.push_back(rough);
    }
  if (beside.size() < kMinSamples || away.size() < kMinSamples) return;
  ringings_.push_back(mean_of(beside) - mean_of(away));
}

CodecEstimate CodecEstimator::finish() const {
  CodecEstimate found{.codec = codec_, .kind = kind_, .predicts = predicts_};
  if (!means_.empty())
    found.quantiser = {.value = mean_of(means_), .sd = sd_of(means_), .is_known = true};
  else
    found.quantiser = {.value = kDefaultQp,
                       .why = frames_ == 0 ? "no frames" : "the footage's stream does not state its quantisers"};
  found.block_grid = mean_estimate(block_grids_, "no gradients to see a grid in");
  found.ringing = mean_estimate(ringings_, "no strong edge, or nothing but edges");
  return found;
}

}  // namespace sigs
