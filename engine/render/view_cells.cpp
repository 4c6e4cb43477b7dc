// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cstddef>

#include "render/renderer.h"

namespace sigs {
namespace {

// The squares of `side` by `side` pixels that a piece touches, one for each of CV_8UC1.
cv::Rect touched_by(const cv::Rect& piece, int side) {
  const cv::Point first(piece.x / side, piece.y / side);
  return {first, cv::Point((piece.br().x + side - 1) / side, (piece.br().y + side - 1) / side)};
}

// The squares of a map that are not 0, row by row, neighbours in a row joined, and rows that are alike; in pixels.
std::vector<cv::Rect> joined(const cv::Mat& squares, int side, const cv::Rect& piece) {
  std::vector<cv::Rect> rects;
  std::size_t above_begin = 0, above_end = 0;  // the rectangles that end with the row above
  const cv::Rect within = touched_by(piece, side) & cv::Rect({0, 0}, squares.size());
  for (int j = within.y; j < within.br().y; ++j) {
    const unsigned char* const row = squares.ptr<unsigned char>(j);
    std::vector<cv::Rect> runs;
    for (int i = within.x; i < within.br().x; ++i) {
      if (row[i] == 0) continue;
      if (runs.empty() || runs.back().br().x != i)
        runs.emplace_back(i, j, 1, 1);
      else
        ++runs.back().width;
    }
    const bool is_alike =
        runs.size() == above_end - above_begin && !runs.empty() && rects[above_begin].br().y == j &&
        std::equal(runs.begin(), runs.end(), rects.begin() + static_cast<std::ptrdiff_t>(above_begin),
                   [](const cv::Rect& a, const cv::Rect& b) { return a.x == b.x && a.width == b.width; });
    if (is_alike) {
      for (std::size_t n = above_begin; n < above_end; ++n) ++rects[n].height;
      continue;
    }
    above_begin = rects.size();
    rects.insert(rects.end(), runs.begin(), runs.end());
    above_end = rects.size();
  }
  for (cv::Rect& rect : rects) rect = (cv::Rect(rect.tl() * side, rect.size() * side) & piece) - piece.tl();
  return rects;
}

}  // namespace

std::vector<cv::Rect> wanted_in(const ViewCells& cells, const cv::Rect& piece) {
  return joined(cells.wanted, cells.step, piece);
}

std::vector<cv::Rect> copied_in(const ViewCells& cells, const cv::Rect& piece) {
  constexpr int kCellsASide = 16;  // of what is copied at least: a call takes as long as copying some thousand pixels
  const cv::Mat& wanted = cells.wanted;
  const cv::Size blocks((wanted.cols + kCellsASide - 1) / kCellsASide, (wanted.rows + kCellsASide - 1) / kCellsASide);
  cv::Mat any = cv::Mat::zeros(blocks, CV_8UC1);
  const cv::Rect within = touched_by(piece, cells.step) & cv::Rect({0, 0}, wanted.size());
  for (int j = within.y; j < within.br().y; ++j)
    for (int i = within.x; i < within.br().x; ++i)
      if (wanted.at<unsigned char>(j, i) != 0) any.at<unsigned char>(j / kCellsASide, i / kCellsASide) = 255;
  return joined(any, kCellsASide * cells.step, piece);
}

}  // namespace sigs
