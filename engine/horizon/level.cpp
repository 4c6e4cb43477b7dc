// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "horizon/horizon.h"

namespace sigs {

namespace {

constexpr double kMinSkyColumns = 0.6, kMinEnds = 0.5;  // of the columns, for skyline_pitch_rad()
constexpr double kAgree_rad = 0.0087;                   // half a degree
constexpr double kDip_rad = 0.0068;                     // sqrt(2 h / R): the horizon's dip seen from 150 m
constexpr int kMinLines = 5;

}  // namespace

ReducedLuma reduced_luma(const cv::Mat& luma) {
  constexpr double kLongest_px = 640;
  const double scale = std::max({luma.cols / kLongest_px, luma.rows / kLongest_px, 1.0});
  ReducedLuma reduced{.luma = luma, .scale = scale};
  const cv::Size size(std::max(1, cvRound(luma.cols / scale)), std::max(1, cvRound(luma.rows / scale)));
  if (size != luma.size()) cv::resize(luma, reduced.luma, size, 0, 0, cv::INTER_AREA);
  return reduced;
}

std::optional<double> skyline_pitch_rad(const SkyMap& sky, double scale, const Camera& camera) {
  if (sky.empty() || sky.columns < kMinSkyColumns) return std::nullopt;
  std::vector<double> pitches_rad;
  for (int x = 0; x < sky.sky.cols; ++x) {
    const int end = sky.end_of(x);
    if (end == 0 || end == sky.sky.rows) continue;
    const auto ray = camera.lens.ray(
        {(x + 0.5) * SkyMap::kCell_px * scale - 0.5, static_cast<double>(end) * SkyMap::kCell_px * scale - 0.5});
    if (ray) pitches_rad.push_back(std::atan2(ray->z, ray->x));
  }
  if (static_cast<double>(pitches_rad.size()) < kMinEnds * sky.sky.cols) return std::nullopt;
  const auto middle = pitches_rad.begin() + static_cast<std::ptrdiff_t>(pitches_rad.size() / 2);
  std::nth_element(pitches_rad.begin(), middle, pitches_rad.end());
  return *middle;
}

std::optional<Level> level_of(std::span<const HorizonLine> lines,
                              std::span<const Eigen::Quaterniond> start_from_camera) {
  std::vector<Eigen::Vector3d> ups;
  for (const HorizonLine& line : lines)
    ups.push_back(start_from_camera[static_cast<std::size_t>(line.frame)] * line.up);
  Level level;
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& middle : ups) {
    int count = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& up : ups) {
      if ((up - middle).norm() > kAgree_rad) continue;
      sum += up;
      ++count;
    }
    if (count > level.lines) {
      level.lines = count;
      best = sum;
    }
  }
  if (level.lines < kMinLines || 2 * level.lines < static_cast<int>(ups.size())) return std::nullopt;
  level.up_in_start = best.normalized();
  double squares = 0;
  for (std::size_t i = 0; i < ups.size(); ++i) {
    if ((ups[i] - level.up_in_start).norm() > kAgree_rad) continue;
    const HorizonLine& line = lines[i];
    squares += std::max((ups[i] - level.up_in_start).squaredNorm() / 2, line.sd_rad * line.sd_rad) +
               line.haze_rad * line.haze_rad + line.hills_rad * line.hills_rad;
  }
  // Haze and hills bias all lines alike, so that none of this shrinks with their number.
  level.sd_rad = std::sqrt(squares / level.lines + kDip_rad * kDip_rad);
  return level;
}

Eigen::Quaterniond world_from_start(const Eigen::Vector3d& up_in_start) {
  const Eigen::Vector3d down = -up_in_start;
  Eigen::Vector3d forward = Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitX().dot(down) * down;
  if (forward.norm() < 1e-6) forward = Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ().dot(down) * down;
  forward.normalize();
  Eigen::Matrix3d world;  // rows: the world's axes in the camera's
  world.row(0) = forward;
  world.row(1) = down.cross(forward);
  world.row(2) = down;
  return Eigen::Quaterniond(world).normalized();
}

}  // namespace sigs
