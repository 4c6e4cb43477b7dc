// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

enum class BoardKind {
  chessboard,
  charuco,  // a chessboard with ArUco markers in its white squares: part of it is enough to be recognised
};

// A flat board with corners at known places. All lengths share one unit, and only the distance of the board depends on
// it: the lens does not.
struct CalibrationBoard {
  BoardKind kind = BoardKind::chessboard;
  cv::Size corners{9, 6};  // inner corners in a row and in a column: one less than squares
  double square_m = 0.025;
  double marker_m = 0.018;  // charuco: side of a marker
  int dictionary = 0;       // charuco: number of the dictionary in cv::aruco

  [[nodiscard]] int corner_count() const { return corners.area(); }

  // Corner `id` in metres on the board, counted row by row from 0; z is 0.
  [[nodiscard]] cv::Point2d corner_m(int id) const {
    return {square_m * (id % corners.width), square_m * (id / corners.width)};
  }
};

// What is seen of the board in one frame. Corners that are not seen are left out.
struct BoardView {
  std::string name;                // of the frame, for people: "frame 120", "left/0001.png"
  std::vector<int> ids;            // of the corners, ascending
  std::vector<cv::Point2d> at_px;  // where they are, as many; pixels as in base/image.h
  double edge_px = 0;              // width of the board's edges, 10 to 90 %: how blurred the view is

  [[nodiscard]] std::size_t size() const { return ids.size(); }
};

// Checks that such a board exists and can be looked for. Errors (usage) name what is wrong: fewer than 3 corners a
// side, more than 100, a marker that is not smaller than its square, a dictionary with too few markers.
[[nodiscard]] Result<void> check_board(const CalibrationBoard& board);

// The number of a dictionary by its name in OpenCV, "DICT_4X4_50". Error usage, which lists the names.
[[nodiscard]] Result<int> dictionary_of(std::string_view name);
[[nodiscard]] std::string dictionary_name(int dictionary);

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

// The board looked for in videos and images.

struct BoardSearch {
  int most_searched = 240;  // frames of a video in which the board is looked for
  std::function<void(int done, int total)> progress = {};
  const std::atomic<bool>* cancel = nullptr;
};

struct BoardFootage {
  std::vector<BoardView> views;
  cv::Size size_px;          // of all images
  int searched = 0;          // frames and images in which the board was looked for
  std::string seen_instead;  // what a few of those without the board show: other_board_in()
  std::vector<Warning> warnings;
};

// Whether a file is read as a single image, by its extension: .png, .jpg, .jpeg, .tif, .tiff, .bmp, .webp, .pgm.
[[nodiscard]] bool is_image_name(const std::filesystem::path& path);

// The views of the board in all inputs: videos, images, and folders of images (in order of their names). Of a video
// longer than `most_searched` frames equal groups of successive frames are made, and of each the frame with the most
// detail is searched (detail_of()). All images must have the size of the first one; others are left out with a warning.
// The result does not depend on the number of threads.
// Errors: cannot_read, bad_data (no image can be read, the size changes within a video), interrupted.
[[nodiscard]] Result<BoardFootage> board_footage(const std::vector<std::filesystem::path>& inputs,
                                                 const CalibrationBoard& board, const BoardSearch& search);

// Which of the views found are used.
struct ViewSelection {
  std::vector<BoardView> views;  // in their order
  int blurred = 0;               // left out for their blur
  int alike = 0;                 // left out because others look the same
};

// Leaves out views whose edges are wider than 1.8 times the first quartile of all and wider than 2.5 px: motion, or
// out of focus. Of the others takes at most `most`, as different as possible: first the sharpest, then each time the
// one that differs most from all taken (Gonzalez 1985). Views differ by where the board's four outer corners are, a
// homography extrapolates those that are not seen, as shares of the image's diagonal; so they differ by position, size
// and tilt. Views that differ by less than a hundredth of the diagonal are alike: a board that is held still counts
// once.
[[nodiscard]] ViewSelection selected_views(std::vector<BoardView> views, const CalibrationBoard& board,
                                           cv::Size size_px, int most = 60);

}  // namespace sigs
