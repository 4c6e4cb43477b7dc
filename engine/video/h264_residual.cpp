// SPDX-License-Identifier: MIT
#include "video/h264_residual.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/ensure.h"

namespace sigs {
namespace {

constexpr int kBlock = 4;
constexpr int kBlocksPerSide = 4;  // of a macroblock of luma

using Block = std::array<int, 16>;  // row by row

// Kinds of positions in a 4x4 block: both indices even, both odd, mixed. Steps differ between them because the rows of
// the integer transform differ in length.
constexpr std::array<int, 16> kKind{0, 2, 0, 2, 2, 1, 2, 1, 0, 2, 0, 2, 2, 1, 2, 1};

// Steps of the decoder (section 8.5.9, normAdjust4x4) by QP % 6 and kind.
constexpr std::array<std::array<int, 3>, 6> kScale{
    {{10, 16, 13}, {11, 18, 14}, {13, 20, 16}, {14, 23, 18}, {16, 25, 20}, {18, 29, 23}}};

// Their reciprocals for the encoder: 2^15 times the gain of both transforms over the step.
constexpr std::array<std::array<int, 3>, 6> kFactor{{{13107, 5243, 8066},
                                                     {11916, 4660, 7490},
                                                     {10082, 4194, 6554},
                                                     {9362, 3647, 5825},
                                                     {8192, 3355, 5243},
                                                     {7282, 2893, 4559}}};

// What encoders add before a level is cut to a whole number, in 64ths: a sixth, as x264 does for predicted blocks.
constexpr int kRounding_64ths = 11;

int quantised(int value, int factor, int shift) {
  const std::int64_t magnitude =
      (std::int64_t{std::abs(value)} * factor + ((std::int64_t{kRounding_64ths} << shift) >> 6)) >> shift;
  return static_cast<int>(value < 0 ? -magnitude : magnitude);
}

// One row or column of the forward transform, in place; its samples lie `step` apart.
void transform(int* v, int step) {
  const int sum_outer = v[0] + v[3 * step];
  const int sum_inner = v[step] + v[2 * step];
  const int outer = v[0] - v[3 * step];
  const int inner = v[step] - v[2 * step];
  v[0] = sum_outer + sum_inner;
  v[step] = 2 * outer + inner;
  v[2 * step] = sum_outer - sum_inner;
  v[3 * step] = outer - 2 * inner;
}

// Section 8.5.12.2.
void inverse_transform(int* v, int step) {
  const int e0 = v[0] + v[2 * step];
  const int e1 = v[0] - v[2 * step];
  const int e2 = (v[step] >> 1) - v[3 * step];
  const int e3 = v[step] + (v[3 * step] >> 1);
  v[0] = e0 + e3;
  v[step] = e1 + e2;
  v[2 * step] = e1 - e2;
  v[3 * step] = e0 - e3;
}

Block transformed(Block block) {
  for (int i = 0; i < 4; ++i) transform(block.data() + 4 * i, 1);
  for (int i = 0; i < 4; ++i) transform(block.data() + i, 4);
  return block;
}

// Levels from coefficient `first` on become scaled coefficients. True: one of them is not 0.
bool quantise(Block& block, int qp, std::size_t first) {
  const auto& factors = kFactor[static_cast<std::size_t>(qp % 6)];
  const auto& scales = kScale[static_cast<std::size_t>(qp % 6)];
  bool coded = false;
  for (std::size_t i = first; i < block.size(); ++i) {
    const auto kind = static_cast<std::size_t>(kKind[i]);
    const int level = quantised(block[i], factors[kind], 15 + qp / 6);
    coded |= level != 0;
    block[i] = (level * scales[kind]) << (qp / 6);
  }
  return coded;
}

// The difference between plane and prediction at (x, y).
Block difference(const cv::Mat& plane, const cv::Mat& predicted, int x, int y) {
  Block block{};
  for (int j = 0; j < kBlock; ++j)
    for (int i = 0; i < kBlock; ++i)
      block[static_cast<std::size_t>(4 * j + i)] = plane.at<uchar>(y + j, x + i) - predicted.at<uchar>(y + j, x + i);
  return block;
}

bool is_zero(const Block& block) {
  return std::all_of(block.begin(), block.end(), [](int value) { return value == 0; });
}

void reconstruct(cv::Mat& plane, const cv::Mat& predicted, int x, int y, Block block) {
  for (int i = 0; i < 4; ++i) inverse_transform(block.data() + 4 * i, 1);
  for (int i = 0; i < 4; ++i) inverse_transform(block.data() + i, 4);
  for (int j = 0; j < kBlock; ++j)
    for (int i = 0; i < kBlock; ++i)
      plane.at<uchar>(y + j, x + i) = cv::saturate_cast<uchar>(
          predicted.at<uchar>(y + j, x + i) + ((block[static_cast<std::size_t>(4 * j + i)] + 32) >> 6));
}

// The 2x2 transform of the means of four chroma blocks, which is its own inverse but for the scale.
std::array<int, 4> means_transformed(const std::array<int, 4>& m) {
  return {m[0] + m[1] + m[2] + m[3], m[0] - m[1] + m[2] - m[3], m[0] + m[1] - m[2] - m[3], m[0] - m[1] - m[2] + m[3]};
}

// Sections 8.5.11.1 and 8.5.11.2.
std::array<int, 4> coded_means(const std::array<int, 4>& means, int qp) {
  std::array<int, 4> levels = means_transformed(means);
  for (int& level : levels) level = quantised(level, kFactor[static_cast<std::size_t>(qp % 6)][0], 16 + qp / 6);
  std::array<int, 4> back = means_transformed(levels);
  for (int& mean : back) mean = ((mean * kScale[static_cast<std::size_t>(qp % 6)][0]) << (qp / 6)) >> 1;
  return back;
}

// Four chroma blocks with their upper left corner at (x, y).
void code_chroma_group(cv::Mat& plane, const cv::Mat& predicted, int x, int y, int qp) {
  std::array<Block, 4> blocks;
  std::array<int, 4> means{};
  bool differs = false;
  for (int k = 0; k < 4; ++k) {
    Block& block = blocks[static_cast<std::size_t>(k)];
    block = difference(plane, predicted, x + kBlock * (k % 2), y + kBlock * (k / 2));
    differs |= !is_zero(block);
    block = transformed(block);
    means[static_cast<std::size_t>(k)] = block[0];
    quantise(block, qp, 1);
  }
  if (!differs) return;
  const std::array<int, 4> coded = coded_means(means, qp);
  for (int k = 0; k < 4; ++k) {
    Block& block = blocks[static_cast<std::size_t>(k)];
    block[0] = coded[static_cast<std::size_t>(k)];
    reconstruct(plane, predicted, x + kBlock * (k % 2), y + kBlock * (k / 2), block);
  }
}

}  // namespace

int chroma_qp(int luma_qp, int offset) {
  constexpr std::array<int, 22> kFrom30{29, 30, 31, 32, 32, 33, 34, 34, 35, 35, 36,
                                        36, 37, 37, 37, 38, 38, 38, 39, 39, 39, 39};
  const int index = std::clamp(luma_qp + offset, 0, 51);
  return index < 30 ? index : kFrom30[static_cast<std::size_t>(index - 30)];
}

CodedBlocks code_luma(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& qp) {
  ENSURE(plane.size() == predicted.size());
  CodedBlocks blocks{cv::Mat::zeros(kBlocksPerSide * qp.rows, kBlocksPerSide * qp.cols, CV_8UC1), qp};
  for (int y = 0; y < plane.rows; y += kBlock)
    for (int x = 0; x < plane.cols; x += kBlock) {
      Block block = difference(plane, predicted, x, y);
      if (is_zero(block)) continue;
      block = transformed(block);
      const bool coded = quantise(block, qp.at<short>(y / 16, x / 16), 0);
      blocks.coded.at<uchar>(y / kBlock, x / kBlock) = coded ? 1 : 0;
      reconstruct(plane, predicted, x, y, block);
    }
  return blocks;
}

void code_chroma(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& qp, cv::Size step, int offset) {
  ENSURE(plane.size() == predicted.size());
  for (int y = 0; y < plane.rows; y += 2 * kBlock)
    for (int x = 0; x < plane.cols; x += 2 * kBlock)
      code_chroma_group(plane, predicted, x, y,
                        chroma_qp(qp.at<short>(y * step.height / 16, x * step.width / 16), offset));
}

}  // namespace sigs
