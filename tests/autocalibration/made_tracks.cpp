// SPDX-License-Identifier: MIT
#include "autocalibration/made_tracks.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/pose.h"

namespace sigs::test {

namespace {

constexpr double kGyroRate_hz = 200;

// Sums of waves for roll, pitch and yaw.
class Swing {
 public:
  Swing(const MadeTurns& settings, cv::RNG& chance) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double slow = settings.pan_rad * (axis == 2 ? 1 : 1.0 / 3);
      for (int i = 0; i < 3; ++i)
        waves_[axis].push_back({slow / (i + 1), chance.uniform(0.06, 0.12) * (i + 1), chance.uniform(0.0, 6.28)});
      for (int i = 0; i < 3; ++i)
        waves_[axis].push_back({settings.shake_rad / 2, chance.uniform(3.0, 8.0), chance.uniform(0.0, 6.28)});
    }
  }

  [[nodiscard]] glm::dquat world_from_camera(double t_s) const {
    return rotation_of({.roll_rad = at(0, t_s), .pitch_rad = at(1, t_s), .yaw_rad = at(2, t_s)});
  }

  // About the camera's axes, by central differences.
  [[nodiscard]] glm::dvec3 rate_radps(double t_s) const {
    constexpr double kHalf_s = 1e-4;
    const glm::dquat turn = glm::conjugate(world_from_camera(t_s - kHalf_s)) * world_from_camera(t_s + kHalf_s);
    return glm::dvec3(turn.x, turn.y, turn.z) * (turn.w < 0 ? -2.0 : 2.0) / (2 * kHalf_s);
  }

 private:
  struct Wave {
    double size_rad, rate_hz, phase_rad;
  };
  [[nodiscard]] double at(std::size_t axis, double t_s) const {
    double sum = 0;
    for (const Wave& w : waves_[axis])
      sum += w.size_rad * std::sin(2 * std::numbers::pi * w.rate_hz * t_s + w.phase_rad);
    return sum;
  }
  std::array<std::vector<Wave>, 3> waves_;
};

std::vector<glm::dvec3> points_of(const Camera& camera, const MadeTurns& settings, cv::RNG& chance) {
  const double wide = std::min(field_rad(camera), std::numbers::pi);
  const auto count = static_cast<int>(120 * 12.57 / (wide * wide * 0.6));
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 direction(chance.gaussian(1), chance.gaussian(1), chance.gaussian(1));
    const double distance_m = settings.speed_mps > 0 ? chance.uniform(30.0, 300.0) : 1e9;
    points.push_back(glm::normalize(direction) * distance_m);
  }
  return points;
}

}  // namespace

MadeTracks made_tracks(const Camera& camera, const MadeTurns& settings) {
  cv::RNG chance(settings.seed * 7919ULL + 1);
  const Swing swing(settings, chance);
  const std::vector<glm::dvec3> points = points_of(camera, settings, chance);
  MadeTracks made;
  made.tracks.size_px = camera.size_px;
  made.tracks.step_px = std::max(1.0, camera.size_px.width / 640.0);
  for (int n = 0; n < settings.frames; ++n) {
    const double t_s = n / settings.rate_hz;
    const glm::dquat camera_from_world = glm::conjugate(swing.world_from_camera(t_s));
    TrackedFrame frame{.number = n, .time_s = t_s};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto pixel =
          camera.lens.pixel(camera_from_world * (points[i] - glm::dvec3(settings.speed_mps * t_s, 0, 0)));
      if (!pixel ||
          !cv::Rect2d(0, 0, camera.size_px.width - 1.0, camera.size_px.height - 1.0).contains({pixel->x, pixel->y}))
        continue;
      glm::dvec2 seen = *pixel + glm::dvec2(chance.gaussian(settings.noise_px), chance.gaussian(settings.noise_px));
      if (static_cast<double>(i) < settings.stray_share * static_cast<double>(points.size()))
        seen += 20.0 * glm::dvec2(std::sin(t_s + static_cast<double>(i)), std::cos(1.3 * t_s + static_cast<double>(i)));
      frame.features.push_back(
          {static_cast<int>(i), cv::Point2f(static_cast<float>(seen.x), static_cast<float>(seen.y))});
    }
    made.tracks.frames.push_back(std::move(frame));
  }
  made.log.camera_rate_radps.source = "made";
  const double end_s = settings.frames / settings.rate_hz + 1;
  for (double t_s = -1; t_s < end_s; t_s += 1 / kGyroRate_hz) {
    const glm::dvec3 noise(chance.gaussian(1), chance.gaussian(1), chance.gaussian(1));
    made.log.camera_rate_radps.times_s.push_back(t_s + settings.gyro_offset_s);
    made.log.camera_rate_radps.values.push_back(settings.gyro_scale * swing.rate_radps(t_s) +
                                                settings.gyro_noise_radps * noise + glm::dvec3(0.01, -0.02, 0.01));
  }
  return made;
}

Camera made_camera(cv::Size size_px, LensModel model, double focal_px, double k1) {
  LensParameters lens{.model = model,
                      .fx = focal_px,
                      .fy = focal_px,
                      .cx = (size_px.width - 1) / 2.0,
                      .cy = (size_px.height - 1) / 2.0};
  if (model == LensModel::kannala_brandt || k1 != 0) lens.coefficients = {k1, 0, 0, 0};
  return {.lens = *Lens::make(lens), .size_px = size_px};
}

double field_rad(const Camera& camera) {
  const double y = (camera.size_px.height - 1) / 2.0;
  const auto left = camera.lens.ray({-0.5, y});
  const auto right = camera.lens.ray({camera.size_px.width - 0.5, y});
  return left && right ? std::acos(glm::dot(*left, *right)) : std::numbers::pi;
}

}  // namespace sigs::test
