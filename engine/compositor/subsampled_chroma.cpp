// SPDX-License-Identifier: MIT
#include "compositor/subsampled_chroma.h"

#include <algorithm>

#include "video/bit_depth.h"

namespace sigs {

namespace {

// First chroma sample, and how many, in which the luma samples begin to end - 1 have weight.
cv::Range chroma_range(const std::vector<ChromaShare>& shares, int begin, int end) {
  const ChromaShare& last = shares[static_cast<size_t>(end - 1)];
  return {shares[static_cast<size_t>(begin)].first, last.first + (last.in_next > 0 ? 2 : 1)};
}

}  // namespace

SubsampledChroma::SubsampledChroma(const Frame& frame, const cv::Rect& part) : frame_(frame) {
  const cv::Size step = chroma_step(frame.layout);
  const cv::Size size = frame.size_px();
  const bool on_column = chroma_on_luma_column(frame.color.chroma_site);
  const bool on_row = chroma_on_luma_row(frame.color.chroma_site);
  column_taps_ = chroma_taps(size.width, step.width, on_column);
  row_taps_ = chroma_taps(size.height, step.height, on_row);
  column_shares_ = chroma_shares(size.width, step.width, on_column);
  row_shares_ = chroma_shares(size.height, step.height, on_row);
  const cv::Range across = chroma_range(column_shares_, part.x, part.br().x);
  const cv::Range down = chroma_range(row_shares_, part.y, part.br().y);
  window_ = {across.start, down.start, across.size(), down.size()};
  sums_ = cv::Mat::zeros(window_.size(), CV_32FC3);
  row_sums_.resize(static_cast<size_t>(window_.width) + 1);
}

void SubsampledChroma::start_row(int y, int begin, int end) {
  row_ = y;
  read_from_ = column_taps_[static_cast<size_t>(begin)].first;
  const int count = column_taps_[static_cast<size_t>(end - 1)].second + 1 - read_from_;
  with_sample_type(frame_.bit_depth, [&](auto sample) {
    read_row<decltype(sample)>(frame_.planes[1], count, read_cb_);
    read_row<decltype(sample)>(frame_.planes[2], count, read_cr_);
  });
  std::fill(row_sums_.begin(), row_sums_.end(), cv::Vec3f(0, 0, 0));
}

template <class Sample>
void SubsampledChroma::read_row(const cv::Mat& plane, int count, std::vector<float>& samples) const {
  const ChromaTap& tap = row_taps_[static_cast<size_t>(row_)];
  const Sample* const first = plane.ptr<Sample>(tap.first) + read_from_;
  const Sample* const second = plane.ptr<Sample>(tap.second) + read_from_;
  samples.resize(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i)
    samples[static_cast<size_t>(i)] =
        static_cast<float>(first[i]) + tap.share * static_cast<float>(second[i] - first[i]);
}

void SubsampledChroma::finish_row() {
  const ChromaShare& share = row_shares_[static_cast<size_t>(row_)];
  add_row_sums(share.first, share.in_first);
  if (share.in_next > 0) add_row_sums(share.first + 1, share.in_next);
}

void SubsampledChroma::add_row_sums(int chroma_row, float weight) {
  cv::Vec3f* const sums = sums_.ptr<cv::Vec3f>(chroma_row - window_.y);
  for (int i = 0; i < window_.width; ++i) sums[i] += weight * row_sums_[static_cast<size_t>(i)];
}

std::vector<SubsampledChroma::Averaging> SubsampledChroma::averaging(const std::vector<ChromaTap>& taps,
                                                                     const std::vector<ChromaShare>& shares,
                                                                     int count) {
  std::vector<Averaging> all(static_cast<size_t>(count), {0, 0, 0});
  const auto add = [&](int chroma, const ChromaTap& tap, float weight) {
    if (weight == 0) return;
    Averaging& weights = all[static_cast<size_t>(chroma)];
    weights[static_cast<size_t>(tap.first - chroma + 1)] += weight * (1 - tap.share);
    weights[static_cast<size_t>(tap.second - chroma + 1)] += weight * tap.share;
  };
  for (size_t i = 0; i < taps.size(); ++i) {
    add(shares[i].first, taps[i], shares[i].in_first);
    add(shares[i].first + 1, taps[i], shares[i].in_next);
  }
  return all;
}

cv::Mat SubsampledChroma::with_border(const cv::Mat& plane, const cv::Rect& window) {
  cv::Mat samples(window.height + 2, window.width + 2, CV_32FC1);
  for (int y = 0; y < samples.rows; ++y) {
    const int row = std::clamp(window.y + y - 1, 0, plane.rows - 1);
    float* const out = samples.ptr<float>(y);
    const auto copy = [&](const auto* const in) {
      for (int x = 0; x < samples.cols; ++x) out[x] = in[std::clamp(window.x + x - 1, 0, plane.cols - 1)];
    };
    if (plane.depth() == CV_8U)
      copy(plane.ptr<uchar>(row));
    else
      copy(plane.ptr<ushort>(row));
  }
  return samples;
}

}  // namespace sigs
