// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "project/project.h"
#include "scene/scene.h"

namespace sigs {

// The frame of each waypoint: its own, or where it has none, spread evenly between the neighbours that have one. The
// first and last waypoint without a frame take the first and last frame of the range.
[[nodiscard]] std::vector<double> waypoint_frames(const std::vector<WaypointSettings>& waypoints, int first_frame,
                                                  int last_frame);

// The waypoints with their times, ready for Trajectory::make.
[[nodiscard]] std::vector<TimedWaypoint> timed_waypoints(const std::vector<WaypointSettings>& waypoints,
                                                         const FootageShape& footage, int first_frame, int last_frame);

}  // namespace sigs
