// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace sigs::made {

struct MotionSettings {
  std::uint32_t seed = 1;
  double duration_s = 10;
  double speed_mps = 22;
  double height_m = 150;
  double pitch_rad = -0.1;  // of the optical axis on average: a little below the horizon
  double drift_rad = 0.03;  // amplitude of the slow changes of attitude
  double shake_rad = 0;     // root mean square about each axis, of waves of 3 to 12 Hz
  double turn_radps = 0;    // straight for a fifth of the duration, a coordinated turn for half of it, straight again
};

// How the camera flies: attitude and place at any time, as closed forms (the place as an integral, exact to 1e-5 m).
// World and camera axes: docs/frames-and-units.md; the camera starts above the world's origin, heading along X.
class Motion {
 public:
  explicit Motion(const MotionSettings& settings);

  // Unit quaternion, at any time; the turn stays within 0..duration_s.
  [[nodiscard]] glm::dquat world_from_camera(double t_s) const;

  // Place of the camera in the world, m; beyond 0.5 s before and after the flight the last place.
  [[nodiscard]] glm::dvec3 position_m(double t_s) const;

  // Angular rate about the camera's axes X, Y, Z, rad/s: from attitudes 0.2 ms apart, by central difference (relative
  // error below 1e-5 for waves of 12 Hz).
  [[nodiscard]] glm::dvec3 camera_rate_radps(double t_s) const;

 private:
  struct Wave {
    double amplitude_rad = 0, rate_hz = 0, phase_rad = 0;
  };
  [[nodiscard]] double turned_rad(double t_s) const;
  [[nodiscard]] double turn_rate_radps(double t_s) const;

  MotionSettings settings_;
  std::array<std::vector<Wave>, 3> waves_;  // of roll, pitch, yaw
  std::vector<glm::dvec3> places_m_;        // every millisecond from -0.5 s
};

}  // namespace sigs::made
