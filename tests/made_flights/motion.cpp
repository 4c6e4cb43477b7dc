// SPDX-License-Identifier: MIT
#include "made_flights/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/pose.h"
#include "made_flights/random.h"

namespace sigs::made {

namespace {

constexpr double kGravity_mps2 = 9.80665, kStep_s = 1e-3, kLead_s = 0.5;
constexpr double kTurnBegin = 0.2, kTurnEnd = 0.7, kRamp = 0.1;  // shares of the duration
constexpr int kShakeWaves = 5, kDriftWaves = 2;

// The smooth step 3 s^2 - 2 s^3, and its integral from 0.
double step_at(double s) {
  const double c = std::clamp(s, 0.0, 1.0);
  return c * c * (3 - 2 * c);
}
double step_integral(double s) {
  const double c = std::clamp(s, 0.0, 1.0);
  return c * c * c * (1 - c / 2) + std::max(0.0, s - 1);
}

}  // namespace

Motion::Motion(const MotionSettings& settings) : settings_(settings) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t seed = scrambled(axis, 7, settings.seed);
    const double rms_share = std::sqrt(2.0 / kShakeWaves);
    for (int i = 0; i < kDriftWaves; ++i)
      waves_[axis].push_back({settings.drift_rad / (1 + i), 0.05 + 0.1 * i + 0.05 * even(i, 0, seed),
                              2 * std::numbers::pi * even(i, 1, seed)});
    for (int i = 0; i < kShakeWaves; ++i)
      waves_[axis].push_back({settings.shake_rad * rms_share, 3 + 9 * (i + even(i, 2, seed)) / kShakeWaves,
                              2 * std::numbers::pi * even(i, 3, seed)});
  }
  const int count = static_cast<int>((settings.duration_s + 2 * kLead_s) / kStep_s) + 2;
  const auto heading = [&](double t_s) { return glm::dvec3(std::cos(turned_rad(t_s)), std::sin(turned_rad(t_s)), 0); };
  glm::dvec3 place_m{-settings.speed_mps * kLead_s, 0, -settings.height_m};
  for (int i = 0; i < count; ++i) {
    places_m_.push_back(place_m);
    place_m += settings.speed_mps * kStep_s * heading((i + 0.5) * kStep_s - kLead_s);
  }
}

double Motion::turn_rate_radps(double t_s) const {
  const double t = t_s / settings_.duration_s;
  return settings_.turn_radps * (step_at((t - kTurnBegin) / kRamp) - step_at((t - kTurnEnd + kRamp) / kRamp));
}

double Motion::turned_rad(double t_s) const {
  const double t = t_s / settings_.duration_s;
  return settings_.turn_radps * settings_.duration_s * kRamp *
         (step_integral((t - kTurnBegin) / kRamp) - step_integral((t - kTurnEnd + kRamp) / kRamp));
}

glm::dquat Motion::world_from_camera(double t_s) const {
  glm::dvec3 angles{std::atan(settings_.speed_mps * turn_rate_radps(t_s) / kGravity_mps2), settings_.pitch_rad,
                    turned_rad(t_s)};
  for (int axis = 0; axis < 3; ++axis)
    for (const Wave& wave : waves_[axis])
      angles[axis] += wave.amplitude_rad * std::sin(2 * std::numbers::pi * wave.rate_hz * t_s + wave.phase_rad);
  return rotation_of({.roll_rad = angles[0], .pitch_rad = angles[1], .yaw_rad = angles[2]});
}

glm::dvec3 Motion::position_m(double t_s) const {
  const double step = std::clamp((t_s + kLead_s) / kStep_s, 0.0, static_cast<double>(places_m_.size()) - 1.001);
  const auto i = static_cast<std::size_t>(step);
  return glm::mix(places_m_[i], places_m_[i + 1], step - static_cast<double>(i));
}

glm::dvec3 Motion::camera_rate_radps(double t_s) const {
  constexpr double kHalf_s = 1e-4;
  glm::dquat turn = glm::conjugate(world_from_camera(t_s - kHalf_s)) * world_from_camera(t_s + kHalf_s);
  if (turn.w < 0) turn = -turn;
  const glm::dvec3 half{turn.x, turn.y, turn.z};
  const double sine = glm::length(half);
  if (sine == 0) return {0, 0, 0};
  return half / sine * (2 * std::atan2(sine, turn.w) / (2 * kHalf_s));
}

}  // namespace sigs::made
