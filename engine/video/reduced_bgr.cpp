// SPDX-License-Identifier: MIT
#include "video/reduced_bgr.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/ensure.h"

namespace sigs {

namespace {

// Blocks of pixels along one axis, and the samples of a plane that they touch.
struct BlocksOfAxis {
  int first_px = 0;
  int end_px = 0;
  int block_px = 1;
  int step_px = 1;  // from sample to sample

  [[nodiscard]] int count() const { return (end_px - first_px + block_px - 1) / block_px; }
  [[nodiscard]] cv::Range samples_of(int block) const {
    const int begin_px = first_px + block * block_px;
    return {begin_px / step_px, (std::min(begin_px + block_px, end_px) + step_px - 1) / step_px};
  }
};

// The blocks of a row: which samples, and by what to multiply their sum.
struct Columns {
  std::vector<cv::Range> samples;
  std::vector<float> shares;
  int first = 0;       // of all samples
  int count = 0;       // of samples
  int even_width = 0;  // samples of each block but the last, which follow one another; 0: not so

  explicit Columns(const BlocksOfAxis& blocks) {
    for (int i = 0; i < blocks.count(); ++i) {
      samples.push_back(blocks.samples_of(i));
      shares.push_back(1.0F / static_cast<float>(samples.back().size()));
    }
    first = samples.front().start;
    count = samples.back().end - first;
    if (blocks.first_px % blocks.step_px == 0 && blocks.block_px % blocks.step_px == 0)
      even_width = blocks.block_px / blocks.step_px;
  }
};

// The sums of all blocks but the last, which may be narrower.
template <int kWidth>
void add_even_blocks(const std::vector<std::int32_t>& sums, std::vector<std::int32_t>& to) {
  const std::int32_t* from = sums.data();
  for (std::size_t i = 0; i + 1 < to.size(); ++i, from += kWidth) to[i] = std::accumulate(from, from + kWidth, 0);
}

// Memory for one row of blocks.
struct RowSums {
  std::vector<std::int32_t> samples;
  std::vector<std::int32_t> blocks;
};

// Loops of a known length, for the widths that footage is shown with, become vector instructions.
void add_blocks(const Columns& columns, RowSums& sums) {
  std::size_t done = sums.blocks.size() - 1;
  if (columns.even_width == 1)
    add_even_blocks<1>(sums.samples, sums.blocks);
  else if (columns.even_width == 2)
    add_even_blocks<2>(sums.samples, sums.blocks);
  else if (columns.even_width == 4)
    add_even_blocks<4>(sums.samples, sums.blocks);
  else
    done = 0;
  const auto samples = sums.samples.begin() - columns.first;
  for (std::size_t i = done; i < sums.blocks.size(); ++i)
    sums.blocks[i] = std::accumulate(samples + columns.samples[i].start, samples + columns.samples[i].end, 0);
}

template <class Sample>
void mean_row(const cv::Mat& plane, const cv::Range& rows, const Columns& columns, RowSums& sums, Sample* means) {
  sums.samples.assign(static_cast<std::size_t>(columns.count), 0);
  sums.blocks.resize(columns.samples.size());
  for (int y = rows.start; y < rows.end; ++y) {
    const Sample* const from = plane.ptr<Sample>(y) + columns.first;
    std::int32_t* const to = sums.samples.data();
    for (int x = 0; x < columns.count; ++x) to[x] += from[x];
  }
  add_blocks(columns, sums);
  const float share = 1.0F / static_cast<float>(rows.size());
  for (std::size_t i = 0; i < sums.blocks.size(); ++i)
    means[i] = static_cast<Sample>(
        static_cast<std::int32_t>(static_cast<float>(sums.blocks[i]) * columns.shares[i] * share + 0.5F));
}

template <class Sample>
cv::Mat block_means(const cv::Mat& plane, const BlocksOfAxis& across, const BlocksOfAxis& down) {
  const Columns columns(across);
  cv::Mat means(down.count(), across.count(), plane.type());
  cv::parallel_for_({0, means.rows}, [&](const cv::Range& part) {
    RowSums sums;
    for (int j = part.start; j < part.end; ++j)
      mean_row(plane, down.samples_of(j), columns, sums, means.ptr<Sample>(j));
  });
  return means;
}

}  // namespace

cv::Mat reduced_bgr(const Frame& frame, const cv::Rect& part, int divisor) {
  ENSURE(divisor >= 2 && divisor <= 128 && !part.empty() && (part & cv::Rect({0, 0}, frame.size_px())) == part);
  Frame small{.layout = frame.layout, .bit_depth = frame.bit_depth, .color = frame.color};
  if (frame.plane_count() == 3 && frame.layout != PixelLayout::rgb) small.layout = PixelLayout::yuv444;
  for (int i = 0; i < frame.plane_count(); ++i) {
    const auto plane = static_cast<std::size_t>(i);
    const cv::Size step = i == 0 ? cv::Size(1, 1) : chroma_step(frame.layout);
    const BlocksOfAxis across{part.x, part.x + part.width, divisor, step.width};
    const BlocksOfAxis down{part.y, part.y + part.height, divisor, step.height};
    small.planes[plane] = with_sample_type(
        frame.bit_depth, [&](auto sample) { return block_means<decltype(sample)>(frame.planes[plane], across, down); });
  }
  return bgr_of(small);
}

}  // namespace sigs
