// SPDX-License-Identifier: MIT
#include "made_boards/board_cases.h"

#include <algorithm>
#include <span>

namespace sigs::made {

namespace {

const BoardCamera kPinhole{"pinhole", {640, 480}, {702, 0, 324.5, 0, 700, 236, 0, 0, 1}, {0, 0, 0, 0, 0}};
const BoardCamera kBrown{
    "brown5", {640, 480}, {520, 0, 312, 0, 521, 244, 0, 0, 1}, {-0.29, 0.1, 0.0008, -0.0005, -0.02}};
// 85 degrees to the image's corners.
const BoardCamera kFisheye{
    "fisheye170", {640, 480}, {262, 0, 323, 0, 262.5, 237, 0, 0, 1}, {0.035, -0.012, 0.004, -0.0008}, true};

PoseRange range_of(const BoardCase& one) {
  PoseRange range;
  range.whole_board = one.board.marker_m <= 0;
  if (one.camera.fisheye) range.smallest_share = 0.4, range.largest_share = 1.1;
  return range;
}

}  // namespace

std::vector<BoardCase> board_cases() {
  std::vector<BoardCase> all;
  for (const BoardCamera& camera : {kPinhole, kBrown, kFisheye})
    for (const bool is_charuco : {false, true})
      for (const bool is_hard : {false, true}) {
        BoardCase one{.name = camera.name + (is_charuco ? "-charuco" : "-chessboard") + (is_hard ? "-hard" : ""),
                      .camera = camera};
        if (is_charuco) one.board = {.corners = {8, 6}, .square_m = 0.03, .marker_m = 0.021};
        if (is_hard) {
          one.exposure = {.blur_px = 1.1, .noise = 6, .gain = 0.7};
          one.frames = 80;
          one.half_bad = true;
        }
        all.push_back(one);
      }
  return all;
}

BoardCase board_case(const std::string& name) {
  for (const BoardCase& one : board_cases())
    if (one.name == name) return one;
  return {};
}

std::vector<cv::Mat> case_images(const BoardCase& one, const BoardRenderer& renderer, std::uint32_t seed, int count) {
  std::vector<cv::Affine3d> poses = made_poses(renderer, count, range_of(one), seed);
  PoseRange outside = range_of(one);
  outside.whole_board = false;
  outside.largest_reach = 1.2;
  const std::vector<cv::Affine3d> partly = made_poses(renderer, count, outside, seed + 1000);
  std::vector<cv::Mat> images;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Exposure exposure = one.exposure;
    exposure.seed = seed * 1000 + static_cast<std::uint32_t>(i);
    // Every fourth is moved, every eighth lies partly outside; the corners of every eighth are spoiled once found.
    std::vector<cv::Affine3d> during{poses[i]};
    if (one.half_bad && i % 4 == 1) during = moving(renderer, poses[i], 40, exposure.seed);
    if (one.half_bad && i % 8 == 3 && i < partly.size()) during = {partly[i]};
    images.push_back(renderer.image(during, exposure));
  }
  return images;
}

cv::Mat video_frame(const BoardCase& one, const BoardRenderer& renderer, std::uint32_t seed, int frames, int number) {
  constexpr int kFramesEach = 8;
  const std::vector<cv::Affine3d> poses =
      made_poses(renderer, std::max(2, (frames + kFramesEach - 1) / kFramesEach + 1), range_of(one), seed);
  Exposure exposure = one.exposure;
  exposure.seed = seed * 100000 + static_cast<std::uint32_t>(number);
  return renderer.image(exposed(poses, kFramesEach, number), exposure);
}

}  // namespace sigs::made
