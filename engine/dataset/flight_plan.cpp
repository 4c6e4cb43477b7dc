// SPDX-License-Identifier: MIT
#include "dataset/flight_plan.h"

#include <algorithm>
#include <cmath>

#include "base/pose.h"
#include "dataset/encounter.h"
#include "dataset/image_flight.h"
#include "dataset/short_text.h"

namespace sigs {

namespace {

constexpr double kMaxDistance_m = 1e8;  // what a waypoint may have
constexpr double kRounding_m = 1e-6;    // what lies below the ground by no more is on it

using Values = std::map<std::string, double>;
template <class T>
using Possible = tl::expected<T, std::string>;

// The frames between which the flight is fixed; a video of one frame still has a velocity.
struct Ends {
  FrameRange frames;
  double first_s = 0;
  double length_s = 0;
};

Ends ends_of(const FlightContext& context) {
  const FrameRange frames{context.frames.first, std::max(context.frames.last, context.frames.first + 1)};
  const double first_s = time_of_frame_s(context.footage, frames.first);
  return {frames, first_s, time_of_frame_s(context.footage, frames.last) - first_s};
}

glm::dvec3 camera_velocity_mps(const FlightContext& context) {
  return {context.camera.speed_mps, 0, 0};
}

glm::dvec3 camera_position_m(const FlightContext& context, double time_s) {
  return context.camera.position_m + time_s * camera_velocity_mps(context);
}

std::optional<double> value_of(const Values& values, const char* name) {
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

Possible<void> check_values(FlightKind kind, const Values& values) {
  for (const FlightQuantity& quantity : quantities_of(kind)) {
    const auto found = values.find(std::string(quantity.name));
    if (found == values.end()) continue;
    if (found->second >= quantity.low && found->second <= quantity.high) continue;
    return tl::unexpected(std::string(quantity.name) + ": is " + short_text(found->second) + "; it must lie between " +
                          short_text(quantity.low) + " and " + short_text(quantity.high));
  }
  return {};
}

// Ray of a place given by two quantities, in world axes.
glm::dvec3 world_ray(const Values& values, const char* x_percent, const char* y_percent, const FlightContext& context) {
  const glm::dquat world_from_camera = rotation_of(mount_attitude(context.camera));
  return world_from_camera * ray_of_place(context.lens, {values.at(x_percent), values.at(y_percent)});
}

bool is_crossing(FlightKind kind) {
  return kind == FlightKind::left_right || kind == FlightKind::right_left;
}

// A crossing keeps its middle, who comes near its end and who moves away its beginning, whatever the speed.
double fixed_share(FlightKind kind) {
  if (is_crossing(kind)) return 0.5;
  return kind == FlightKind::approaching ? 1 : 0;
}

Possible<RelativeMotion> template_motion(FlightKind kind, const Values& values, const FlightContext& context) {
  const glm::dvec3 from_ray = world_ray(values, "from_x_percent", "from_y_percent", context);
  const glm::dvec3 to_ray = world_ray(values, "to_x_percent", "to_y_percent", context);
  const RelativePath path = is_crossing(kind)
                                ? crossing(from_ray, to_ray, values.at("distance_m"))
                                : radial(from_ray, to_ray, values.at("from_distance_m"), values.at("to_distance_m"));
  const double length_s = ends_of(context).length_s;
  const std::optional<double> speed_mps = value_of(values, "speed_mps");
  if (!speed_mps) return motion_over_time(path, length_s);
  return motion_at_speed(path, length_s, *speed_mps, context.camera.speed_mps, fixed_share(kind));
}

// Where neither time nor range says when, the closest approach is in the last frame.
EncounterTiming timing_of(const Values& values, const Ends& ends) {
  EncounterTiming timing{.closing_speed_mps = value_of(values, "closing_speed_mps"),
                         .time_of_closest_approach_s = value_of(values, "time_of_closest_approach_s"),
                         .range_m = value_of(values, "range_m")};
  const bool one_is_given = timing.closing_speed_mps.has_value() != timing.range_m.has_value();
  if (one_is_given && !timing.time_of_closest_approach_s) timing.time_of_closest_approach_s = ends.length_s;
  return timing;
}

Possible<Encounter> encounter_of(const Values& values, const Ends& ends) {
  return timed_encounter({.miss_distance_m = values.at("miss_distance_m"),
                          .miss_angle_deg = values.at("miss_angle_deg"),
                          .bearing_deg = values.at("bearing_deg"),
                          .elevation_deg = values.at("elevation_deg")},
                         timing_of(values, ends));
}

void add_derived(const Encounter& encounter, std::map<std::string, double>& derived) {
  derived["closing_speed_mps"] = encounter.closing_speed_mps;
  derived["time_of_closest_approach_s"] = encounter.time_of_closest_approach_s;
  derived["range_m"] = first_range_m(encounter);
}

// What decides how fast the intruder flies.
std::string ways_out(FlightKind kind, const Values& values) {
  if (kind == FlightKind::encounter)
    return values.contains("closing_speed_mps") ? "closing_speed_mps or bearing_deg"
                                                : "range_m, time_of_closest_approach_s or bearing_deg";
  if (values.contains("speed_mps")) return "speed_mps";
  return is_crossing(kind) ? "distance_m or frames" : "from_distance_m, to_distance_m or frames";
}

Possible<void> check_speed(FlightKind kind, const Values& values, double speed_mps, const FlightContext& context) {
  const std::optional<Span>& limits = context.speed_limits_mps;
  if (!limits || (speed_mps >= limits->low && speed_mps <= limits->high)) return {};
  return tl::unexpected("speed_mps: the intruder would have to fly " + short_text(speed_mps) +
                        " m/s; its aircraft flies " + short_text(limits->low) + " to " + short_text(limits->high) +
                        "; change " + ways_out(kind, values) + ", or the aircraft's speed_limits_mps");
}

Possible<void> check_waypoint(FlightKind kind, const WaypointSettings& waypoint) {
  const glm::dvec3& p_m = waypoint.position_m;
  const char* const height =
      kind == FlightKind::encounter ? "elevation_deg, miss_angle_deg" : "from_y_percent, to_y_percent";
  const std::string frame = " in frame " + std::to_string(std::lround(*waypoint.frame));
  if (p_m.z > kRounding_m)
    return tl::unexpected(height + std::string(": the intruder is underground") + frame + ", " + short_text(p_m.z) +
                          " m below z = 0");
  if (glm::max(glm::max(std::abs(p_m.x), std::abs(p_m.y)), std::abs(p_m.z)) > kMaxDistance_m)
    return tl::unexpected("the intruder is farther than 1e8 m from the world's origin" + frame);
  return {};
}

Possible<RelativeMotion> motion_of(FlightKind kind, const Values& values, const FlightContext& context,
                                   std::map<std::string, double>& derived) {
  if (kind != FlightKind::encounter) return template_motion(kind, values, context);
  const Possible<Encounter> encounter = encounter_of(values, ends_of(context));
  if (!encounter) return tl::unexpected(encounter.error());
  add_derived(*encounter, derived);
  return relative_motion(*encounter);
}

}  // namespace

Possible<PlannedFlight> planned_flight(FlightKind kind, const Values& values, const FlightContext& context) {
  if (const Possible<void> checked = check_values(kind, values); !checked) return tl::unexpected(checked.error());
  const Ends ends = ends_of(context);
  if (!(ends.length_s > 0)) return tl::unexpected(std::string("frames: the footage's times do not increase"));
  PlannedFlight flight;
  const Possible<RelativeMotion> motion = motion_of(kind, values, context, flight.derived);
  if (!motion) return tl::unexpected(motion.error());
  const double speed_mps = glm::length(motion->velocity_mps + camera_velocity_mps(context));
  if (const Possible<void> checked = check_speed(kind, values, speed_mps, context); !checked)
    return tl::unexpected(checked.error());
  for (const auto& [frame, since_s] : {std::pair{ends.frames.first, 0.0}, std::pair{ends.frames.last, ends.length_s}}) {
    flight.waypoints.push_back(
        {.frame = frame, .position_m = camera_position_m(context, ends.first_s + since_s) + motion->at(since_s)});
    const Possible<void> checked = check_waypoint(kind, flight.waypoints.back());
    if (!checked) return tl::unexpected(checked.error());
  }
  flight.derived["speed_mps"] = speed_mps;
  flight.derived["nearest_m"] = min_range_m(*motion, ends.length_s);
  return flight;
}

}  // namespace sigs
