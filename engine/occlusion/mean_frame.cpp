// SPDX-License-Identifier: MIT
#include "occlusion/mean_frame.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/ensure.h"

namespace sigs {

namespace {

constexpr int kMaxWidth = 640;        // pixels; finer means cost time and do not make edges more exact
constexpr int kMaxBox = 4;            // 4 * 4 pixels * 8 frames * 255 still fit 16 bits
constexpr int kMaxFramesPerMean = 8;  // frames
constexpr int kMeansAtFirst = 8;      // number of means of one frame each, before groups become longer

void add_row(const std::uint8_t* luma, std::uint16_t* sums, int count) {
  for (int x = 0; x < count; ++x) sums[x] = static_cast<std::uint16_t>(sums[x] + luma[x]);
}

void add_row_of_pairs(const std::uint8_t* luma, std::uint16_t* sums, int count) {
  for (int x = 0; x < count; ++x) sums[x] = static_cast<std::uint16_t>(sums[x] + luma[2 * x] + luma[2 * x + 1]);
}

void add_row_of_boxes(const std::uint8_t* luma, std::uint16_t* sums, int count, int scale, int box) {
  for (int x = 0; x < count; ++x) {
    int sum = sums[x];
    for (int k = 0; k < box; ++k) sum += luma[x * scale + k];
    sums[x] = static_cast<std::uint16_t>(sum);
  }
}

constexpr std::size_t kMaxSegments = 48;

MeanFrame merged(const MeanFrame& a, const MeanFrame& b) {
  const int frames = a.frames + b.frames;
  return {a.luma * (1.0 * a.frames / frames) + b.luma * (1.0 * b.frames / frames), frames};
}

void append(std::vector<MeanFrame>& segments, const MeanFrame& image, int max_frames) {
  if (segments.empty() || segments.back().frames + image.frames > max_frames)
    segments.push_back(image);
  else
    segments.back() = merged(segments.back(), image);
}

}  // namespace

FrameAverager::FrameAverager(cv::Size size_px)
    : size_px_(size_px),
      scale_(std::min({(size_px.width + kMaxWidth - 1) / kMaxWidth, size_px.width, size_px.height})),
      box_(std::min(scale_, kMaxBox)) {
  ENSURE(size_px.width > 0 && size_px.height > 0);
  sum_ = cv::Mat::zeros(size_px.height / scale_, size_px.width / scale_, CV_16UC1);
}

void FrameAverager::add(const cv::Mat& luma) {
  ENSURE(luma.type() == CV_8UC1 && luma.size() == size_px_ && !is_full());
  for (int y = 0; y < sum_.rows; ++y)
    for (int k = 0; k < box_; ++k) {
      const auto* from = luma.ptr<std::uint8_t>(y * scale_ + k);
      auto* to = sum_.ptr<std::uint16_t>(y);
      if (scale_ == 1) add_row(from, to, sum_.cols);
      if (scale_ == 2) add_row_of_pairs(from, to, sum_.cols);
      if (scale_ > 2) add_row_of_boxes(from, to, sum_.cols, scale_, box_);
    }
  ++frames_;
  ++waiting_;
}

bool FrameAverager::is_full() const {
  const int before = frames_ - waiting_;
  return waiting_ >= std::clamp(before / kMeansAtFirst, 1, kMaxFramesPerMean);
}

MeanFrame FrameAverager::image() const {
  ENSURE(waiting_ > 0);
  MeanFrame image{.frames = waiting_};
  sum_.convertTo(image.luma, CV_32F, 1.0 / (waiting_ * box_ * box_));
  return image;
}

void FrameAverager::clear() {
  sum_.setTo(0);
  waiting_ = 0;
}

void FootageSegments::add(const MeanFrame& image) {
  append(segments_, image, max_frames_);
  while (segments_.size() > kMaxSegments) {
    max_frames_ *= 2;
    std::vector<MeanFrame> longer;
    for (const MeanFrame& segment : segments_) append(longer, segment, max_frames_);
    segments_ = std::move(longer);
  }
}

}  // namespace sigs
