// SPDX-License-Identifier: MIT
#include "flights/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flights/random.h"

namespace sigs::flights {

namespace {

constexpr double kFrameRate_hz = 25, kSpeed_mps = 20, kWeave_s = 45;
constexpr double kHalfFieldOfView_deg = 32.5;  // across

double rad(double deg) {
  return deg * std::numbers::pi / 180;
}

// A sine of its own phase. part distinguishes the motions of a flight.
double swing(double t_s, double rate_hz, int part, std::uint32_t seed) {
  return std::sin(2 * std::numbers::pi * (rate_hz * t_s + random_share(part, 7, seed)));
}

cv::Matx33d world_from_camera(double yaw_rad, double pitch_rad, double roll_rad) {
  const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad), cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
  const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
  return {cp * cy,
          sr * sp * cy - cr * sy,
          cr * sp * cy + sr * sy,
          cp * sy,
          sr * sp * sy + cr * cy,
          cr * sp * sy - sr * cy,
          -sp,
          sr * cp,
          cr * cp};
}

double mean_pitch_deg(const Path& path, int frame) {
  const double t = std::clamp((frame - path.level_from) / kFrameRate_hz, 0.0, 1.0);
  return path.first_pitch_deg + (path.pitch_deg - path.first_pitch_deg) * t * t * (3 - 2 * t);
}

}  // namespace

View view_at(const Path& path, cv::Size size_px, int frame) {
  const double t_s = path.still ? 0 : frame / kFrameRate_hz;
  const auto sway_deg = [&](double deg, double rate_hz, int part) {
    return path.sway * deg * swing(t_s, rate_hz, part, path.seed);
  };
  const double turn = 2 * std::numbers::pi / kWeave_s;
  const double heading_rad = std::atan2(path.weave_m * turn * std::cos(turn * t_s), kSpeed_mps);
  const double yaw_rad = heading_rad + rad(sway_deg(1.5, 0.19, 1) + sway_deg(0.4, 0.83, 2));
  const double pitch_rad =
      rad(mean_pitch_deg(path, frame) + sway_deg(1.6, 0.16, 3) + sway_deg(0.6, 0.55, 4) + sway_deg(0.15, 2.1, 5));
  const double roll_rad = rad(sway_deg(4, 0.11, 6) + sway_deg(1.7, 0.37, 7) + sway_deg(0.3, 1.7, 8));
  const double start_m = 1000 * random_share(9, 9, path.seed);
  return {.size_px = size_px,
          .focal_px = 0.5 * size_px.width / std::tan(rad(kHalfFieldOfView_deg)),
          .position_m = {start_m + kSpeed_mps * t_s, path.weave_m * std::sin(turn * t_s),
                         -path.height_m - 8 * path.sway * swing(t_s, 0.05, 10, path.seed)},
          .world_from_camera = world_from_camera(yaw_rad, pitch_rad, roll_rad)};
}

}  // namespace sigs::flights
