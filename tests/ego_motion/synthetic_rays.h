// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "ego_motion/rotation_fit.h"
#include "ego_motion/time_offset.h"

namespace sigs::test {

// A camera that flies over points whose places are known: the rays along which it sees them, without any image.
struct RayFlight {
  std::vector<FrameRays> frames;
  std::vector<double> times_s;
  std::vector<glm::dquat> start_from_camera;  // the truth, against frame 0
};

struct RayFlightSettings {
  int frames = 100;
  double rate_hz = 25;
  int points = 220;          // seen at a time
  double pixel_rad = 0.002;  // 500 px a radian
  double noise_px = 0.1;     // of each ray, in each direction
  double speed_mps = 22;
  double height_m = 150;
  glm::dvec3 turn_radps{0, 0, 0};  // even, about the camera's axes
  double shake_rad = 0;            // from frame to frame
  double moving_share = 0;         // of the points that drift together, as clouds do
  double clouds_m = 0;             // not 0: the sky is a layer of clouds at this height above, moved by the wind
  double wind_mps = 45;            // to the right, of these clouds
  double pitch_rad = 0;            // of the optical axis, upwards
  double readout_s = 0;
  unsigned seed = 1;
};

[[nodiscard]] RayFlight ray_flight(const RayFlightSettings& settings);

// The slow twin of time_offset(): the correlation of all turns at every offset, steps of 5 ms, and the parabola through
// the highest and those 10 ms beside it.
struct ExhaustiveOffset {
  double offset_s = 0;
  double correlation = -2;  // at the highest step; -2: nowhere 20 turns can be compared
};
[[nodiscard]] ExhaustiveOffset exhaustive_offset(std::span<const SeenTurn> turns, const RateIntegral& rates,
                                                 double max_offset_s);

}  // namespace sigs::test
