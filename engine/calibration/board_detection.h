// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "calibration/board.h"

namespace sigs {

// The board in an image (CV_8UC1), corners to some hundredths of a pixel. A chessboard is found as a whole only, of a
// ChArUco board 8 corners or more that do not lie on one line. Images wider than 1280 px are searched at that width;
// the corners are refined at full size. The view's name is left empty.
//   chessboard  OpenCV's sector-based detector (Duda, Frese 2018), then each corner as the saddle between four squares
//   in
//               a window of 0.4 squares
//   charuco     markers by OpenCV, then the same in a window that ends before the markers
[[nodiscard]] std::optional<BoardView> found_board(const cv::Mat& luma, const CalibrationBoard& board);

// What is in the image instead of the board that was asked for: "a chessboard of 8x5 inner corners", "markers of
// DICT_5X5_100". Empty where neither can be seen. Slow: for a few images of those without a board.
[[nodiscard]] std::string other_board_in(const cv::Mat& luma, const CalibrationBoard& board);

// Width of the edges between squares, 10 to 90 % of their contrast, px: medians of those along rows and along columns,
// the larger of both, since motion widens the edges across it. Some 1.5 px in a sharp image. 0 where no edge has
// contrast.
[[nodiscard]] double board_edge_px(const cv::Mat& luma, const BoardView& view, const CalibrationBoard& board);

// How much of an image's luma changes from column to column and from row to row: compares successive frames of a video,
// of which the sharper has the larger value.
[[nodiscard]] double detail_of(const cv::Mat& luma);

}  // namespace sigs
