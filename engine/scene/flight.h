// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace sigs {

// How an intruder flies at one moment.
struct FlightState {
  double time_s = 0;
  glm::dvec3 position_m{0, 0, 0};  // world
  double speed_mps = 0;
  double climb_rate_mps = 0;    // up is positive
  double load_factor = 1;       // (acceleration - gravity) / g along the aircraft's own up axis; 1 in level flight
  double side_load_factor = 0;  // the same along its right wing; 0 in a coordinated turn
  double bank_rad = 0;
};

[[nodiscard]] FlightState flight_at(const SceneIntruder& intruder, double time_s);

// The moment within the scene's frames at which an intruder's reference point is nearest to the camera, between frames
// too. The earliest of equals.
struct ClosestApproach {
  double frame = 0;
  double time_s = 0;
  double distance_m = 0;
};
[[nodiscard]] ClosestApproach closest_approach(const Scene& scene, int intruder);

// What an aircraft of some size could fly; says nothing of a particular type.
struct FlightLimits {
  double highest_speed_mps = 0;
  double highest_climb_mps = 0;  // and descent
  double highest_load_factor = 0;
  double lowest_load_factor = 0;
};

// CS-25 (2.5, -1) for aircraft over 18 m long, CS-23 normal category (3.8, -1.52) below; speeds are those that no such
// civil aircraft in service exceeds. length_m is the extent along the nose.
[[nodiscard]] FlightLimits limits_of(double length_m);

enum class FlightFault { speed, climb, load, underground };

// A stretch of frames in which a limit is broken; the world's ground is z = 0.
struct FlightFlag {
  FlightFault fault = FlightFault::speed;
  double first_frame = 0;
  double last_frame = 0;
  double worst = 0;  // the value farthest beyond the limit: m/s, m/s, g, metres below ground; descent is negative
  double limit = 0;  // of the same sign: a lowest load factor and a highest descent are below zero

  [[nodiscard]] std::string text() const;  // "load factor 5.2, at most 2.5 for an aircraft of this size"
};

// By first frame. Looked at each frame of the scene's range and twice in between; at most some thousand samples however
// long it is. The highest load counts sideways load too: a tight turn with level wings is none that can be flown.
[[nodiscard]] std::vector<FlightFlag> flight_flags(const Scene& scene, int intruder);

}  // namespace sigs
