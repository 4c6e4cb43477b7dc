// SPDX-License-Identifier: MIT
#include "scene/geo_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "project/places.h"
#include "scene/scene_at.h"

namespace sigs {

namespace {

constexpr double kMargin_s = 10;  // of a recorded path before and after the scene's range

constexpr std::array<std::array<std::uint8_t, 3>, 5> kIntruderColors{
    {{255, 90, 60}, {0, 220, 255}, {120, 255, 90}, {255, 110, 255}, {255, 255, 255}}};

// Neglects the angle between the tangent plane at the world's origin and that at the body: 1e-5 degrees a metre.
Attitude against_north(const LocalFrame& earth, const glm::dquat& world_from_body) {
  return attitude_of(rotation_of({0, 0, earth.heading_rad()}) * world_from_body);
}

struct PlacedBody {
  glm::dvec3 position_m;
  glm::dquat world_from_body;
};

template <class BodyAt>
GeoPath path_over(const Scene& scene, GeoPath path, const BodyAt& body_at) {
  path.utc = scene.utc_at_frame_0_s.has_value();
  path.description += " Heights are above the WGS-84 ellipsoid.";
  for (int frame = scene.first_frame; frame <= scene.last_frame; ++frame) {
    const double time_s = time_of_frame_s(scene.footage, frame);
    const PlacedBody body = body_at(time_s);
    path.points.push_back({scene.utc_at_frame_0_s.value_or(0) + time_s, scene.earth->place_of(body.position_m)});
    path.attitudes.push_back(against_north(*scene.earth, body.world_from_body));
  }
  return path;
}

// The part of a path between two times, ends interpolated. Empty where it has nothing there.
std::vector<TimedPlace> between(const std::vector<TimedPlace>& points, double first_s, double last_s) {
  std::vector<TimedPlace> part;
  const auto at = [](const TimedPlace& a, const TimedPlace& b, double time_s) {
    const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
    const auto mixed = [share](double from, double to) { return from + share * (to - from); };
    return TimedPlace{
        time_s,
        {mixed(a.place.latitude_deg, b.place.latitude_deg),
         // The shorter way, across the antimeridian too.
         std::remainder(
             a.place.longitude_deg + share * std::remainder(b.place.longitude_deg - a.place.longitude_deg, 360), 360),
         mixed(a.place.height_m, b.place.height_m)}};
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_within = points[i].time_s >= first_s && points[i].time_s <= last_s;
    if (i > 0)
      for (const double cut_s : {first_s, last_s})
        if (points[i - 1].time_s < cut_s && points[i].time_s > cut_s)
          part.push_back(at(points[i - 1], points[i], cut_s));
    if (is_within) part.push_back(points[i]);
  }
  return part;
}

Result<double> footage_time_of_first_point(const RecordedPath& path, const Scene& scene,
                                           const TrafficSettings& settings) {
  if (!path.has_times) return fail(path.name, "has no times, which an intruder's flight needs", ErrorKind::usage);
  if (settings.at_frame) return time_of_frame_s(scene.footage, *settings.at_frame);
  if (!path.utc || !scene.utc_at_frame_0_s)
    return fail(path.name,
                path.utc ? "is in UTC, which the footage's log does not know; say at which frame it begins"
                         : "does not know UTC; say at which frame it begins",
                ErrorKind::usage);
  return path.points.front().time_s - *scene.utc_at_frame_0_s;
}

}  // namespace

std::vector<GeoPath> geo_paths_of(const Scene& scene) {
  std::vector<GeoPath> paths;
  paths.push_back(path_over(scene, {.name = "camera", .description = "The UAV's camera."}, [&](double time_s) {
    const Pose<frame::World, frame::Camera> pose = camera_at(scene.motion, time_s);
    return PlacedBody{pose.translation_m, pose.rotation};
  }));
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
    const SceneIntruder& intruder = scene.intruders[i];
    GeoPath path{.name = intruder.name,
                 .description = "Simulated intruder.",
                 .color_rgb = kIntruderColors[i % kIntruderColors.size()]};
    paths.push_back(path_over(scene, std::move(path), [&](double time_s) {
      const Pose<frame::World, frame::Body> pose = intruder.trajectory.world_from_body(time_s);
      return PlacedBody{pose.translation_m, pose.rotation};
    }));
  }
  return paths;
}

Result<std::vector<WaypointSettings>> traffic_waypoints(const RecordedPath& path, const Scene& scene,
                                                        const TrafficSettings& settings) {
  if (!scene.earth)
    return fail("geo",
                "the project does not say where on the Earth its world lies; set geo.latitude_deg, "
                "geo.longitude_deg, geo.height_m and geo.heading_deg, or give the camera a log with positions",
                ErrorKind::usage);
  const Result<double> first_s = footage_time_of_first_point(path, scene, settings);
  if (!first_s) return fail(first_s.error());
  RecordedPath part = path;
  for (TimedPlace& point : part.points) {
    point.time_s += *first_s - path.points.front().time_s;
    point.place.height_m += settings.height_offset_m;
  }
  part.points = between(part.points, time_of_frame_s(scene.footage, scene.first_frame) - kMargin_s,
                        time_of_frame_s(scene.footage, scene.last_frame) + kMargin_s);
  if (part.points.empty())
    return fail(path.name, "is nowhere near the footage's time; say at which frame it begins", ErrorKind::usage);
  std::vector<WaypointSettings> waypoints;
  for (const WorldWaypoint& point : waypoints_of(part, *scene.earth, settings.tolerance_m)) {
    const GeodeticPosition place = scene.earth->place_of(point.position_m);
    waypoints.push_back({.frame = frame_at_time(scene.footage, point.time_s),
                         .position_m = point.position_m,
                         .place = PlaceSettings{place.latitude_deg, place.longitude_deg, place.height_m}});
  }
  return waypoints;
}

void take_traffic(Project& project, std::size_t intruder, std::vector<WaypointSettings> waypoints, const Scene& scene) {
  const GeodeticPosition& origin = scene.earth->origin();
  project.geo = {.latitude_deg = origin.latitude_deg,
                 .longitude_deg = origin.longitude_deg,
                 .height_m = origin.height_m,
                 .heading_deg = deg_of_rad(scene.earth->heading_rad())};
  project.intruders.at(intruder).trajectory.waypoints = std::move(waypoints);
  place_waypoints(project);
}

}  // namespace sigs
