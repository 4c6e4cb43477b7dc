// SPDX-License-Identifier: MIT
#include "project/places.h"

#include <cmath>
#include <cstddef>

namespace sigs {

namespace {

GeodeticPosition geodetic_of(const PlaceSettings& place) {
  return {place.latitude_deg, place.longitude_deg, place.height_m};
}

bool is_on_earth(const PlaceSettings& place) {
  return std::abs(place.latitude_deg) <= 90 && std::abs(place.longitude_deg) <= 180 && std::isfinite(place.height_m);
}

bool is_finite_point(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// The same waypoint before the edit; null where there was none.
const WaypointSettings* waypoint_at(const Project& project, std::size_t intruder, std::size_t waypoint) {
  if (intruder >= project.intruders.size()) return nullptr;
  const std::vector<WaypointSettings>& waypoints = project.intruders[intruder].trajectory.waypoints;
  return waypoint < waypoints.size() ? &waypoints[waypoint] : nullptr;
}

void keep_place(const WaypointSettings* before, bool is_same_world, const LocalFrame& earth,
                WaypointSettings& waypoint) {
  const bool was_moved = before != nullptr && is_same_world && before->place == waypoint.place &&
                         before->position_m != waypoint.position_m && is_finite_point(waypoint.position_m);
  if (was_moved) {
    const GeodeticPosition place = earth.place_of(waypoint.position_m);
    waypoint.place = {place.latitude_deg, place.longitude_deg, place.height_m};
  } else if (is_on_earth(*waypoint.place)) {
    waypoint.position_m = earth.world_of(geodetic_of(*waypoint.place));
  }
}

}  // namespace

std::optional<LocalFrame> stated_frame(const GeoSettings& geo) {
  if (!geo.latitude_deg || !geo.longitude_deg || !geo.height_m || !geo.heading_deg) return std::nullopt;
  const PlaceSettings origin{*geo.latitude_deg, *geo.longitude_deg, *geo.height_m};
  if (!is_on_earth(origin) || !std::isfinite(*geo.heading_deg)) return std::nullopt;
  return LocalFrame(geodetic_of(origin), rad_of_deg(*geo.heading_deg));
}

void place_waypoints(Project& project) {
  const std::optional<LocalFrame> earth = stated_frame(project.geo);
  if (!earth) return;
  for (IntruderSettings& intruder : project.intruders)
    for (WaypointSettings& waypoint : intruder.trajectory.waypoints)
      if (waypoint.place && is_on_earth(*waypoint.place))
        waypoint.position_m = earth->world_of(geodetic_of(*waypoint.place));
}

void keep_places(const Project& before, Project& after) {
  const std::optional<LocalFrame> earth = stated_frame(after.geo);
  if (!earth) return;
  const bool is_same_world = before.geo == after.geo;
  for (std::size_t i = 0; i < after.intruders.size(); ++i) {
    std::vector<WaypointSettings>& waypoints = after.intruders[i].trajectory.waypoints;
    for (std::size_t j = 0; j < waypoints.size(); ++j)
      if (waypoints[j].place) keep_place(waypoint_at(before, i, j), is_same_world, *earth, waypoints[j]);
  }
}

}  // namespace sigs
