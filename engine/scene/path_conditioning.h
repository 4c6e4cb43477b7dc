// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"

namespace sigs {

// How stiff the waypoints of the project's intruder are over the scene's range (spline/conditioning.h). Nothing for an
// approximating spline, whose shape knows no times. The intruder has a trajectory that can be flown.
[[nodiscard]] std::optional<double> path_condition(const Project& project, std::size_t intruder, const Scene& scene);

// Where the path overshoots farther off the straight way between two waypoints than any leg around is long: which
// intruder, which frames, how far, and what to do. The worst place is told, others are counted.
[[nodiscard]] std::optional<Problem> overshoot_issue(const Project& project, std::size_t intruder, const Scene& scene);

}  // namespace sigs
