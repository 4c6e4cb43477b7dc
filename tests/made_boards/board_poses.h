// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "made_boards/made_board.h"

namespace sigs::made {

// Poses as a person shows a board to a camera.
struct PoseRange {
  double largest_tilt_deg = 45;  // against facing the camera
  double smallest_share = 0.25;  // the board's longer side as a share of the image's width, seen from the front
  double largest_share = 0.7;
  double largest_angle_deg = 70;  // of the board's middle from the axis
  bool whole_board = true;        // all of it is in the image
  double largest_reach = 1;       // of the middle: share of the way to the image's edge
};

// `count` poses from the seed. The optical frame's are in front of the camera.
[[nodiscard]] std::vector<cv::Affine3d> made_poses(const BoardRenderer& renderer, int count, const PoseRange& range,
                                                   std::uint32_t seed);

// The poses during an exposure that moves the board by about `blur_px` in the image, at random in its direction.
[[nodiscard]] std::vector<cv::Affine3d> moving(const BoardRenderer& renderer, const cv::Affine3d& pose, double blur_px,
                                               std::uint32_t seed);

// The poses during the exposure of frame `frame` of a video that goes from pose to pose in `frames_each` frames, slowly
// near each and fast between. The shutter is open for half of a frame's time.
[[nodiscard]] std::vector<cv::Affine3d> exposed(const std::vector<cv::Affine3d>& poses, int frames_each, int frame);

}  // namespace sigs::made
