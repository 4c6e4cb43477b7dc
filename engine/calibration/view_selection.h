// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "calibration/board.h"

namespace sigs {

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
