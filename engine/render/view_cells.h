// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sigs {

// Cells of step by step pixels of a view, from its upper left corner on; those at the lower and right border may extend
// beyond it.
struct ViewCells {
  cv::Mat wanted;  // CV_8UC1, one each; 0: not wanted
  int step = 1;
};

// The wanted cells within a piece of the view, as rectangles that do not overlap; in pixels of the piece.
[[nodiscard]] std::vector<cv::Rect> wanted_in(const ViewCells& cells, const cv::Rect& piece);

// Rectangles that contain all wanted cells within a piece, few of them, so that each can be copied by a call of its
// own; in pixels of the piece, without overlap.
[[nodiscard]] std::vector<cv::Rect> copied_in(const ViewCells& cells, const cv::Rect& piece);

}  // namespace sigs
