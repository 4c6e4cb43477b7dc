// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdlib>

#include "video/h264_residual.h"

namespace sigs {
namespace {

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

void deblock_luma(cv::Mat& plane, const CodedBlocks& blocks) {
  EdgeFilter(plane, blocks, {1, 1}, false, 0).run();
}

void deblock_chroma(cv::Mat& plane, const CodedBlocks& blocks, cv::Size step, int offset) {
  EdgeFilter(plane, blocks, step, true, offset).run();
}

}  // namespace sigs
