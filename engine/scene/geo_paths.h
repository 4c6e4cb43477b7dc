// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/result.h"
#include "geo/geo_path.h"
#include "geo/recorded_path.h"
#include "project/project.h"
#include "scene/scene.h"

namespace sigs {

// An encounter on the globe, and recorded traffic as an encounter's intruder.

// The paths of the camera ("camera", its axes as attitude) and of all intruders, with a point for each frame of the
// scene's range: for KML and CZML. In UTC where the camera's log states it. The scene must have a place on the Earth.
[[nodiscard]] std::vector<GeoPath> geo_paths_of(const Scene& scene);

struct TrafficSettings {
  std::optional<double> at_frame;  // frame of the footage at which the path's first point is passed; none: by UTC
  double tolerance_m = 2;          // how far off the recorded points the waypoints' straight lines may pass
  double height_offset_m = 0;      // added to the path's heights, to bring them to the ellipsoid
};

// A recorded path as waypoints: places on the Earth with the frames at which they are passed. What lies more than ten
// seconds before or after the scene's range is left out.
// Errors (usage): the scene has no place on the Earth; without at_frame, path or scene do not know UTC; the path has no
// times, or none near the scene's range.
[[nodiscard]] Result<std::vector<WaypointSettings>> traffic_waypoints(const RecordedPath& path, const Scene& scene,
                                                                      const TrafficSettings& settings);

// Makes the waypoints those of an intruder, and states the world's place on the Earth in the project, since places
// need it: what the scene had from the camera's log is written into project.geo.
void take_traffic(Project& project, std::size_t intruder, std::vector<WaypointSettings> waypoints, const Scene& scene);

}  // namespace sigs
