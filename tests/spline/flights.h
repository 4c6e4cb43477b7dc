// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "spline/trajectory.h"

namespace sigs::test {

// Waypoints of flights that the tests share. World: Z down, so a climb goes to smaller z.

// Level circle about the origin at 150 m height, beginning on world +X. side +1 turns right, -1 left.
[[nodiscard]] std::vector<TimedWaypoint> circle(double radius_m, double speed_mps, double turns, int side);

// Level run-in along +X, one loop upward, level run-out.
[[nodiscard]] std::vector<TimedWaypoint> loop(double radius_m, double speed_mps);

// Level, up into the vertical, straight up, pushed over forward into level flight.
[[nodiscard]] std::vector<TimedWaypoint> climb_and_push_over();

// A, B, A: stops at B for an instant and returns on the same line.
[[nodiscard]] std::vector<TimedWaypoint> reversal(const glm::dvec3& towards_m);

// Several waypoints at the same place, in the middle of a flight.
[[nodiscard]] std::vector<TimedWaypoint> pause();

// Three waypoints at the same place: the approximating spline stops there for an instant and leaves at 45 degrees.
[[nodiscard]] std::vector<TimedWaypoint> cusp();

// count waypoints anywhere in a cube of 400 m, 0.4 to 4 s apart; the same for the same seed.
[[nodiscard]] std::vector<TimedWaypoint> wild(int count, unsigned seed);

struct Flight {
  std::string name;
  std::vector<TimedWaypoint> waypoints;
};

// All of the above and the degenerate ones: one waypoint, two, two straight up, all at one place.
[[nodiscard]] std::vector<Flight> all_flights();

// Every combination of spline, timing and bank.
[[nodiscard]] std::vector<TrajectorySettings> all_settings();

// For INFO in a test that goes over many.
[[nodiscard]] std::string name_of(const TrajectorySettings& settings);

// Stops the test where the waypoints are refused.
[[nodiscard]] Trajectory trajectory_through(const std::vector<TimedWaypoint>& waypoints,
                                            const TrajectorySettings& settings = {});

// Angle of the rotation that leads from one attitude to another, 0..pi.
[[nodiscard]] double rotation_between_rad(const glm::dquat& a, const glm::dquat& b);

[[nodiscard]] bool is_finite(const glm::dvec3& v);

}  // namespace sigs::test
