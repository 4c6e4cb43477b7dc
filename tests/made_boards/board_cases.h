// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "made_boards/board_poses.h"
#include "made_boards/made_board.h"

namespace sigs::made {

// Lenses, boards and footage that the calibration is measured with.
struct BoardCase {
  std::string name;
  BoardCamera camera;
  MadeBoard board;
  Exposure exposure;
  int frames = 40;
  bool half_bad =
      false;  // every other view is bad: moved by 40 px while exposed, beyond the image's edge, corners wrong
};

// Each of pinhole, 5 coefficients and a fisheye of 170 degrees with a chessboard and with a ChArUco board, easy and
// hard (more blur, more noise, half the views bad). 640x480.
[[nodiscard]] std::vector<BoardCase> board_cases();
[[nodiscard]] BoardCase board_case(const std::string& name);

// The first `count` images of a case, one pose each.
[[nodiscard]] std::vector<cv::Mat> case_images(const BoardCase& one, const BoardRenderer& renderer, std::uint32_t seed,
                                               int count);

// Frame `number` of a video of so many frames in which the board goes from pose to pose, 8 frames each.
[[nodiscard]] cv::Mat video_frame(const BoardCase& one, const BoardRenderer& renderer, std::uint32_t seed, int frames,
                                  int number);

}  // namespace sigs::made
