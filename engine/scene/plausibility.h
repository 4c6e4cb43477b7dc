// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"

namespace sigs {

// Bounds of the size and speed of aircraft. The fastest aircraft with a crew and jet engines, the SR-71, flew at some
// 980 m/s; airships were up to 245 m long, aeroplanes up to 120 m wide.
inline constexpr double kFastestAircraft_mps = 1000;
inline constexpr double kMaxAircraft_m = 300;
inline constexpr double kMinAircraft_m = 0.1;

// Settings that can be used but are implausible, in the project's order of fields: calibrations with warnings, an
// own-body mask that covers nearly everything or nothing, a camera below the ground (z > 0), models larger or smaller
// than any aircraft, trajectories faster than any aircraft or below the ground, and paths that overshoot farther off
// the straight line between two waypoints than the legs around are long. What lint() finds
// follows for each intruder. Trajectories are sampled at each frame, at
// fewer frames where intruders or frames are very many. Whether an intruder is ever visible: scene/visibility.h.
//   intruder_of_project  for each of the project's intruders its index in scene.intruders; -1: it is not in the scene
[[nodiscard]] std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene,
                                                       const std::vector<int>& intruder_of_project);

// The same for a scene that has all intruders in the project's order, as open_scene gives it.
[[nodiscard]] std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene);

// Condition number of the interpolation through the intruder's waypoints over the scene's range of frames
// (spline/conditioning.h): large where neighbouring legs last very differently long. None for an approximating
// spline, whose shape does not depend on times. The waypoints must make a trajectory.
//   intruder  index in project.intruders
[[nodiscard]] std::optional<double> path_condition(const Project& project, std::size_t intruder, const Scene& scene);

}  // namespace sigs
