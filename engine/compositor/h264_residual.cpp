// SPDX-License-Identifier: MIT
#include "compositor/recompression.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/ensure.h"

namespace sigs {
namespace {

constexpr int kTransform_px = 4;
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
  for (int j = 0; j < kTransform_px; ++j)
    for (int i = 0; i < kTransform_px; ++i)
      block[static_cast<std::size_t>(4 * j + i)] = plane.at<uchar>(y + j, x + i) - predicted.at<uchar>(y + j, x + i);
  return block;
}

bool is_zero(const Block& block) {
  return std::all_of(block.begin(), block.end(), [](int value) { return value == 0; });
}

void reconstruct(cv::Mat& plane, const cv::Mat& predicted, int x, int y, Block block) {
  for (int i = 0; i < 4; ++i) inverse_transform(block.data() + 4 * i, 1);
  for (int i = 0; i < 4; ++i) inverse_transform(block.data() + i, 4);
  for (int j = 0; j < kTransform_px; ++j)
    for (int i = 0; i < kTransform_px; ++i)
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
    block = difference(plane, predicted, x + kTransform_px * (k % 2), y + kTransform_px * (k / 2));
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
    reconstruct(plane, predicted, x + kTransform_px * (k % 2), y + kTransform_px * (k / 2), block);
  }
}

// Tables 8-16 and 8-17 of H.264, from index 16 on: thresholds of the difference across the edge and along a side, and
// the largest change at boundary strength 2.
constexpr std::array<int, 36> kAlpha{4,  4,  5,  6,  7,  8,  9,  10, 12,  13,  15,  17,  20,  22,  25,  28,  32,  36,
                                     40, 45, 50, 56, 63, 71, 80, 90, 101, 113, 127, 144, 162, 182, 203, 226, 255, 255};
constexpr std::array<int, 36> kBeta{2,  2,  2,  3,  3,  3,  3,  4,  4,  4,  6,  6,  7,  7,  8,  8,  9,  9,
                                    10, 10, 11, 11, 12, 12, 13, 13, 14, 14, 15, 15, 16, 16, 17, 17, 18, 18};
constexpr std::array<int, 36> kClip{0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1,  1,  1,  2,  2,  2,
                                    2, 3, 3, 3, 4, 4, 5, 5, 6, 7, 8, 8, 10, 11, 12, 13, 15, 17};

struct Thresholds {
  int alpha = 0;
  int beta = 0;
  int clip = 0;

  explicit Thresholds(int qp) {
    if (qp < 16) return;
    const auto i = static_cast<std::size_t>(qp - 16);
    alpha = kAlpha[i];
    beta = kBeta[i];
    clip = kClip[i];
  }
};

// The six samples across an edge: p2 p1 p0 | q0 q1 q2, `step` apart; q0 is given.
class Crossing {
 public:
  Crossing(uchar* q0, std::ptrdiff_t step) : q0_(q0), step_(step) {}

  [[nodiscard]] bool is_filtered(const Thresholds& t) const {
    return std::abs(p(0) - q(0)) < t.alpha && std::abs(p(1) - p(0)) < t.beta && std::abs(q(1) - q(0)) < t.beta;
  }

  // Section 8.7.2.3, luma.
  void filter_luma(const Thresholds& t) {
    if (!is_filtered(t)) return;
    const bool p_is_smooth = std::abs(p(2) - p(0)) < t.beta;
    const bool q_is_smooth = std::abs(q(2) - q(0)) < t.beta;
    const int middle = (p(0) + q(0) + 1) >> 1;
    const int p1 = p(1) + std::clamp((p(2) + middle - 2 * p(1)) >> 1, -t.clip, t.clip);
    const int q1 = q(1) + std::clamp((q(2) + middle - 2 * q(1)) >> 1, -t.clip, t.clip);
    move_edge(t.clip + (p_is_smooth ? 1 : 0) + (q_is_smooth ? 1 : 0));
    if (p_is_smooth) at(-2) = static_cast<uchar>(p1);
    if (q_is_smooth) at(1) = static_cast<uchar>(q1);
  }

  void filter_chroma(const Thresholds& t) {
    if (is_filtered(t)) move_edge(t.clip + 1);
  }

 private:
  [[nodiscard]] uchar& at(int i) const { return q0_[i * step_]; }
  [[nodiscard]] int p(int i) const { return at(-1 - i); }
  [[nodiscard]] int q(int i) const { return at(i); }

  void move_edge(int most) {
    const int delta = std::clamp((4 * (q(0) - p(0)) + p(1) - q(1) + 4) >> 3, -most, most);
    const int p0 = p(0) + delta;
    const int q0 = q(0) - delta;
    at(-1) = cv::saturate_cast<uchar>(p0);
    at(0) = cv::saturate_cast<uchar>(q0);
  }

  uchar* q0_;
  std::ptrdiff_t step_;
};

// The edges of a plane's 4x4 blocks, in units of the plane.
class EdgeFilter {
 public:
  EdgeFilter(cv::Mat& plane, const CodedBlocks& blocks, cv::Size step, bool is_chroma, int offset)
      : plane_(plane), blocks_(blocks), step_(step), is_chroma_(is_chroma), offset_(offset) {}

  void run() {
    for (int row = 0; row < blocks_.qp.rows; ++row)
      for (int column = 0; column < blocks_.qp.cols; ++column) {
        for (int x = 0; x < 16 / step_.width; x += 4) vertical(column * 16 / step_.width + x, row);
        for (int y = 0; y < 16 / step_.height; y += 4) horizontal(row * 16 / step_.height + y, column);
      }
  }

 private:
  // The edge between columns x - 1 and x within a row of macroblocks.
  void vertical(int x, int row) {
    if (x == 0 || x >= plane_.cols) return;
    const int end = std::min(plane_.rows, (row + 1) * 16 / step_.height);
    for (int y = row * 16 / step_.height; y < end; ++y) filter({x, y}, {1, 0}, 1);
  }

  void horizontal(int y, int column) {
    if (y == 0 || y >= plane_.rows) return;
    const int end = std::min(plane_.cols, (column + 1) * 16 / step_.width);
    for (int x = column * 16 / step_.width; x < end; ++x)
      filter({x, y}, {0, 1}, static_cast<std::ptrdiff_t>(plane_.step));
  }

  // At q0 = at, across the edge in a direction.
  void filter(cv::Point at, cv::Point across, std::ptrdiff_t step) {
    const cv::Point q(at.x * step_.width, at.y * step_.height);
    const cv::Point p((at.x - across.x) * step_.width, (at.y - across.y) * step_.height);
    if (blocks_.coded.at<uchar>(q.y / 4, q.x / 4) == 0 && blocks_.coded.at<uchar>(p.y / 4, p.x / 4) == 0) return;
    const Thresholds thresholds((qp_at(p) + qp_at(q) + 1) >> 1);
    Crossing crossing(plane_.ptr<uchar>(at.y) + at.x, step);
    if (is_chroma_)
      crossing.filter_chroma(thresholds);
    else
      crossing.filter_luma(thresholds);
  }

  [[nodiscard]] int qp_at(cv::Point luma) const {
    const int qp = blocks_.qp.at<short>(luma.y / 16, luma.x / 16);
    return is_chroma_ ? chroma_qp(qp, offset_) : qp;
  }

  cv::Mat& plane_;
  const CodedBlocks& blocks_;
  cv::Size step_;
  bool is_chroma_;
  int offset_;
};

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
  for (int y = 0; y < plane.rows; y += kTransform_px)
    for (int x = 0; x < plane.cols; x += kTransform_px) {
      Block block = difference(plane, predicted, x, y);
      if (is_zero(block)) continue;
      block = transformed(block);
      const bool coded = quantise(block, qp.at<short>(y / 16, x / 16), 0);
      blocks.coded.at<uchar>(y / kTransform_px, x / kTransform_px) = coded ? 1 : 0;
      reconstruct(plane, predicted, x, y, block);
    }
  return blocks;
}

void code_chroma(cv::Mat& plane, const cv::Mat& predicted, const cv::Mat& qp, cv::Size step, int offset) {
  ENSURE(plane.size() == predicted.size());
  for (int y = 0; y < plane.rows; y += 2 * kTransform_px)
    for (int x = 0; x < plane.cols; x += 2 * kTransform_px)
      code_chroma_group(plane, predicted, x, y,
                        chroma_qp(qp.at<short>(y * step.height / 16, x * step.width / 16), offset));
}

void deblock_luma(cv::Mat& plane, const CodedBlocks& blocks) {
  EdgeFilter(plane, blocks, {1, 1}, false, 0).run();
}

void deblock_chroma(cv::Mat& plane, const CodedBlocks& blocks, cv::Size step, int offset) {
  EdgeFilter(plane, blocks, step, true, offset).run();
}

}  // namespace sigs
