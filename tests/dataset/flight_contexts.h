// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "dataset/flight_plan.h"
#include "spline/trajectory.h"

namespace sigs::test {

struct NamedLens {
  std::string name;
  Camera camera;
};

// From a telephoto lens to a fisheye with a field of more than a hemisphere.
[[nodiscard]] std::vector<NamedLens> example_lenses();

// Footage of 25 frames a second; `jitter_s` makes every third frame late.
[[nodiscard]] FootageShape footage_of(int frames, double jitter_s = 0);

// All quantities of a kind that have a default, overridden by those given.
[[nodiscard]] std::map<std::string, double> values_with(FlightKind kind, const std::map<std::string, double>& given);

// How the context's camera sees a planned flight at a time: from the camera, in world axes.
[[nodiscard]] glm::dvec3 relative_position_m(const FlightContext& context, const Trajectory& trajectory, double time_s);

[[nodiscard]] Trajectory trajectory_of(const FlightContext& context, const PlannedFlight& flight);

// The same point in the camera's frame.
[[nodiscard]] glm::dvec3 in_camera(const FlightContext& context, const glm::dvec3& in_world_from_camera);

}  // namespace sigs::test
