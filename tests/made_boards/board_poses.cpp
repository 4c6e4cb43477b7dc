// SPDX-License-Identifier: MIT
#include "made_boards/board_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>

namespace sigs::made {

namespace {

double rad(double angle_deg) {
  return angle_deg * std::numbers::pi / 180;
}

// The direction of a pixel; behind the camera where the lens has none.
cv::Vec3d direction(const BoardCamera& camera, cv::Point2d pixel) {
  std::vector<cv::Point2d> plane;
  if (camera.fisheye)
    cv::fisheye::undistortPoints(std::vector{pixel}, plane, camera.matrix, camera.coefficients);
  else
    cv::undistortPoints(std::vector{pixel}, plane, camera.matrix, camera.coefficients);
  if (cv::norm(plane[0]) > 60) return {0, 0, -1};
  return cv::normalize(cv::Vec3d(plane[0].x, plane[0].y, 1));
}

cv::Matx33d turn(const cv::Vec3d& rotation_rad) {
  return cv::Affine3d(rotation_rad).rotation();
}

// Turns the axis towards a direction, without roll.
cv::Matx33d facing(const cv::Vec3d& towards) {
  const double angle = std::acos(std::clamp(towards[2], -1.0, 1.0));
  const cv::Vec3d axis(-towards[1], towards[0], 0);
  const double length = cv::norm(axis);
  return length < 1e-12 ? cv::Matx33d::eye() : turn(axis * (angle / length));
}

cv::Affine3d random_pose(const BoardRenderer& renderer, const PoseRange& range, cv::RNG& random) {
  const BoardCamera& camera = renderer.camera();
  const MadeBoard& board = renderer.board();
  const double reach = range.largest_reach / 2;
  const cv::Point2d pixel((0.5 + random.uniform(-reach, reach)) * camera.size_px.width,
                          (0.5 + random.uniform(-reach, reach)) * camera.size_px.height);
  const cv::Vec3d towards = direction(camera, pixel);
  const double length_m = (std::max(board.corners.width, board.corners.height) + 1) * board.square_m;
  const double share = random.uniform(range.smallest_share, range.largest_share);
  const double distance_m = length_m * camera.matrix(0, 0) / (share * camera.size_px.width);
  const double tilt = rad(random.uniform(0.0, range.largest_tilt_deg));
  const double about = random.uniform(0.0, 2 * std::numbers::pi);
  const cv::Matx33d rotation = facing(towards) * turn({tilt * std::cos(about), tilt * std::sin(about), 0}) *
                               turn({0, 0, rad(random.uniform(-25.0, 25.0))});
  const cv::Vec3d middle((board.corners.width - 1) * board.square_m / 2,
                         (board.corners.height - 1) * board.square_m / 2, 0);
  return {rotation, towards * distance_m - rotation * middle};
}

cv::Affine3d between(const cv::Affine3d& a, const cv::Affine3d& b, double share) {
  const cv::Affine3d turn_of(a.rotation().t() * b.rotation());
  return {a.rotation() * turn(turn_of.rvec() * share), a.translation() * (1 - share) + b.translation() * share};
}

}  // namespace

std::vector<cv::Affine3d> made_poses(const BoardRenderer& renderer, int count, const PoseRange& range,
                                     std::uint32_t seed) {
  cv::RNG random(seed * 7919U + 17U);
  std::vector<cv::Affine3d> poses;
  for (int tries = 0; static_cast<int>(poses.size()) < count && tries < 20000; ++tries) {
    const cv::Affine3d pose = random_pose(renderer, range, random);
    const cv::Vec3d middle = pose.translation();
    if (middle[2] < std::cos(rad(range.largest_angle_deg)) * cv::norm(middle)) continue;
    if (range.whole_board && !renderer.is_inside(pose, 4)) continue;
    poses.push_back(pose);
  }
  return poses;
}

std::vector<cv::Affine3d> moving(const BoardRenderer& renderer, const cv::Affine3d& pose, double blur_px,
                                 std::uint32_t seed) {
  constexpr int kSteps = 9;
  cv::RNG random(seed * 104729U + 5U);
  const double about = random.uniform(0.0, 2 * std::numbers::pi);
  const double way_m = blur_px * cv::norm(pose.translation()) / renderer.camera().matrix(0, 0);
  std::vector<cv::Affine3d> poses;
  for (int i = 0; i < kSteps; ++i) {
    const double share = (i + 0.5) / kSteps - 0.5;
    poses.emplace_back(pose.rotation(),
                       pose.translation() + cv::Vec3d(std::cos(about), std::sin(about), 0) * (share * way_m));
  }
  return poses;
}

std::vector<cv::Affine3d> exposed(const std::vector<cv::Affine3d>& poses, int frames_each, int frame) {
  constexpr int kSteps = 5;
  std::vector<cv::Affine3d> during;
  for (int i = 0; i < kSteps; ++i) {
    const double time =
        std::clamp((frame + 0.5 * (i + 0.5) / kSteps) / frames_each, 0.0, static_cast<double>(poses.size()) - 1.000001);
    const auto first = static_cast<std::size_t>(time);
    const double share = time - static_cast<double>(first);
    during.push_back(between(poses[first], poses[first + 1], share * share * (3 - 2 * share)));
  }
  return during;
}

}  // namespace sigs::made
