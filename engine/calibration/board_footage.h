// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/board.h"

namespace sigs {

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
