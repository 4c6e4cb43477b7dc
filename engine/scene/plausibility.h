// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"

namespace sigs {

// No aircraft is faster: the fastest with a crew and jet engines, the SR-71, reached some 980 m/s.
inline constexpr double kFastestAircraft_mps = 1000;
inline constexpr double kMaxAircraft_m = 300;  // airships were up to 245 m, aeroplanes up to 120 m
inline constexpr double kMinAircraft_m = 0.1;

// What can be used but is hardly meant, in the project's order of fields: doubtful calibrations, an own-body mask that
// hides everything or nothing, models of no aircraft's size, flights faster than any aircraft or below the ground
// (z > 0), paths that overshoot far beyond their waypoints. Looks at what is opened alone; what takes a look through
// the lens is in outlook.h. Flights are looked at at each frame, at less of them where intruders or frames are very
// many.
//   intruder_of_project  number in scene.intruders of each of the project's; -1: it is not there
[[nodiscard]] std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene,
                                                       const std::vector<int>& intruder_of_project);

// The same where all are there in order, as open_scene has them.
[[nodiscard]] std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene);

}  // namespace sigs
