// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "geo/geodetic.h"
#include "project/project.h"

namespace sigs {

// Waypoints that are places on the Earth. Their position_m follows the place and the project's origin; both are kept in
// step by the functions here, so that all others need position_m alone.

// The world on the Earth where the project itself states it: latitude, longitude, height and heading, all finite and in
// range. None otherwise: a part is missing, or comes from the camera's log.
[[nodiscard]] std::optional<LocalFrame> stated_frame(const GeoSettings& geo);

// Sets position_m of each waypoint that has a place. Without a stated frame nothing changes (validate() reports it).
void place_waypoints(Project& project);

// After an edit: a waypoint that has been moved in the world gets the place where it is; one whose place, or whose
// world, has changed gets its position_m from it.
//   before  the project before the edit; waypoints are compared by their index
void keep_places(const Project& before, Project& after);

}  // namespace sigs
