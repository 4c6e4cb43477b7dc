// SPDX-License-Identifier: MIT
#include "dataset/flight_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ensure.h"
#include "base/text.h"

namespace sigs {

namespace {

constexpr double kMinCosToAxis = 0.25881904510252074;  // cosine of 75 degrees

glm::dvec3 rounded(const glm::dvec3& p_m) {
  return glm::round(p_m * 1024.0) / 1024.0;
}

// The ray of a pixel; none where it is more than 75 degrees from the optical axis.
std::optional<glm::dvec3> near_ray(const Lens& lens, const glm::dvec2& pixel) {
  const std::optional<glm::dvec3> ray = lens.ray(pixel);
  return ray && ray->x >= kMinCosToAxis ? ray : std::nullopt;
}

constexpr double kMaxCoordinate_m = 1e8;  // of a waypoint from the origin, along each axis
constexpr double kRounding_m = 1e-6;      // a position below the ground by no more than this is on it

glm::dvec3 camera_velocity_mps(const FlightContext& context) {
  return {context.camera.speed_mps, 0, 0};
}

std::optional<double> value_of(const FlightValues& values, const char* name) {
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

Possible<void> check_values(FlightKind kind, const FlightValues& values) {
  for (const FlightQuantity& quantity : quantities_of(kind)) {
    const auto found = values.find(std::string(quantity.name));
    if (found == values.end()) continue;
    if (found->second >= quantity.low && found->second <= quantity.high) continue;
    return tl::unexpected(fmt::format("{}: is {}; it must lie between {} and {}", quantity.name,
                                      short_number_text(found->second), short_number_text(quantity.low),
                                      short_number_text(quantity.high)));
  }
  return {};
}

// Ray of a place given by two quantities, in world axes.
glm::dvec3 world_ray(const FlightValues& values, const char* x_percent, const char* y_percent,
                     const FlightContext& context) {
  const glm::dquat world_from_camera = rotation_of(mount_attitude(context.camera));
  return world_from_camera * ray_of_place(context.lens, {values.at(x_percent), values.at(y_percent)});
}

// The path of an intruder given by two places in the image: two points relative to the camera, in world axes.
struct RelativePath {
  glm::dvec3 from_m{0, 0, 0};
  glm::dvec3 to_m{0, 0, 0};
};

// Paths between two unit rays, in world axes. Points are rounded to 2^-10 m, since the last digits of a lens model
// differ between machines.
//   crossing: straight from ray to ray, perpendicular to the direction half-way between them, and distance_m away where
//             it crosses that direction
//   radial: from a distance on one ray to a distance on the other
RelativePath crossing(const glm::dvec3& from_ray, const glm::dvec3& to_ray, double distance_m) {
  const glm::dvec3 ahead = glm::normalize(from_ray + to_ray);
  return {rounded(from_ray * (distance_m / glm::dot(from_ray, ahead))),
          rounded(to_ray * (distance_m / glm::dot(to_ray, ahead)))};
}

RelativePath radial(const glm::dvec3& from_ray, const glm::dvec3& to_ray, double from_distance_m,
                    double to_distance_m) {
  return {rounded(from_ray * from_distance_m), rounded(to_ray * to_distance_m)};
}

// From the path's first point to its last one in length_s > 0.
RelativeMotion motion_over_time(const RelativePath& path, double length_s) {
  ENSURE(length_s > 0);
  return {.start_m = path.from_m, .velocity_mps = (path.to_m - path.from_m) / length_s};
}

// Motion along the line of the path at which the intruder flies speed_mps over ground while the camera flies
// camera_speed_mps along world X. Its position agrees with that of motion_over_time() at `fixed_share` of the time: 0
// at the start, 0.5 half-way, 1 at the end. Where the intruder is too slow to move along that line: the reason.
Possible<RelativeMotion> motion_at_speed(const RelativePath& path, double length_s, double speed_mps,
                                         double camera_speed_mps, double fixed_share) {
  const double path_length_m = glm::length(path.to_m - path.from_m);
  if (path_length_m == 0) return tl::unexpected(std::string("speed_mps: the intruder keeps its place in the image"));
  const glm::dvec3 along = (path.to_m - path.from_m) / path_length_m;
  // |camera velocity + relative speed * along| = speed_mps, the forward one of two solutions.
  const double camera_along_mps = camera_speed_mps * along.x;
  const double root =
      camera_along_mps * camera_along_mps + (speed_mps - camera_speed_mps) * (speed_mps + camera_speed_mps);
  const double relative_mps = root >= 0 ? std::sqrt(root) - camera_along_mps : 0;
  if (!(relative_mps > 0))
    return tl::unexpected(fmt::format(
        "speed_mps: at {} m/s the intruder cannot fly along that line before a camera that flies {} m/s itself",
        short_number_text(speed_mps), short_number_text(camera_speed_mps)));
  const glm::dvec3 velocity_mps = along * relative_mps;
  const glm::dvec3 fixed_m = path.from_m + fixed_share * (path.to_m - path.from_m);
  return RelativeMotion{.start_m = fixed_m - fixed_share * length_s * velocity_mps, .velocity_mps = velocity_mps};
}

bool is_crossing(FlightKind kind) {
  return kind == FlightKind::left_right || kind == FlightKind::right_left;
}

// The share of the time at which the position does not depend on the speed: the middle of a crossing, the end of an
// approach, the beginning of a flight away.
double fixed_share(FlightKind kind) {
  if (is_crossing(kind)) return 0.5;
  return kind == FlightKind::approaching ? 1 : 0;
}

Possible<RelativeMotion> template_motion(FlightKind kind, const FlightValues& values, const FlightContext& context) {
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

// Where neither time nor range is given, the closest approach is in the last frame.
EncounterTiming timing_of(const FlightValues& values, const FlightEnds& ends) {
  EncounterTiming timing{.closing_speed_mps = value_of(values, "closing_speed_mps"),
                         .time_of_closest_approach_s = value_of(values, "time_of_closest_approach_s"),
                         .range_m = value_of(values, "range_m")};
  const bool one_is_given = timing.closing_speed_mps.has_value() != timing.range_m.has_value();
  if (one_is_given && !timing.time_of_closest_approach_s) timing.time_of_closest_approach_s = ends.length_s;
  return timing;
}

Possible<Encounter> encounter_of(const FlightValues& values, const FlightEnds& ends) {
  return timed_encounter({.miss_distance_m = values.at("miss_distance_m"),
                          .miss_angle_deg = values.at("miss_angle_deg"),
                          .bearing_deg = values.at("bearing_deg"),
                          .elevation_deg = values.at("elevation_deg")},
                         timing_of(values, ends));
}

void add_derived(const Encounter& encounter, FlightValues& derived) {
  derived["closing_speed_mps"] = encounter.closing_speed_mps;
  derived["time_of_closest_approach_s"] = encounter.time_of_closest_approach_s;
  derived["range_m"] = first_range_m(encounter);
}

// Directions at a place of the image, unit vectors in world axes: of its ray, and right and up in the image there.
struct ImageAxes {
  glm::dvec3 ray, right, up;
};

Possible<ImageAxes> axes_at(const FlightValues& values, const FlightContext& context) {
  const glm::dvec2 place_percent(values.at("x_percent"), values.at("y_percent"));
  const glm::dvec2 size_px(context.lens.size_px.width, context.lens.size_px.height);
  const std::optional<glm::dvec3> ray = near_ray(context.lens.lens, place_percent / 100.0 * size_px - 0.5);
  if (!ray)
    return tl::unexpected(
        fmt::format("x_percent, y_percent: at {}, {} the lens has no ray within 75 degrees of its axis",
                    short_number_text(place_percent.x), short_number_text(place_percent.y)));
  const glm::dquat world_from_camera = rotation_of(mount_attitude(context.camera));
  const glm::dvec3 right = glm::normalize(glm::dvec3(0, 1, 0) - ray->y * *ray);
  return ImageAxes{world_from_camera * *ray, world_from_camera * right, world_from_camera * glm::cross(right, *ray)};
}

// Velocity of the relative motion over ground, by course_deg and climb_deg.
glm::dvec3 velocity_over_ground(const FlightValues& values, double course_deg, const FlightContext& context) {
  const glm::dvec3 looks = rotation_of(mount_attitude(context.camera)) * glm::dvec3(1, 0, 0);
  const double level = std::hypot(looks.x, looks.y);
  constexpr double kVertical = 1e-6;
  const glm::dvec3 forward = level > kVertical ? glm::dvec3(looks.x, looks.y, 0) / level : glm::dvec3(1, 0, 0);
  const glm::dvec3 right(-forward.y, forward.x, 0);
  const CosSin course = cos_sin_of_deg(course_deg);
  const CosSin climb = cos_sin_of_deg(values.at("climb_deg"));
  return values.at("relative_speed_mps") *
         (climb.cos * (course.cos * forward + course.sin * right) + climb.sin * glm::dvec3(0, 0, -1));
}

// The motion that is distance_m away on the place's ray at that time.
Possible<RelativeMotion> motion_at_distance(const FlightValues& values, const FlightContext& context,
                                            double since_first_s, double distance_m) {
  const Possible<ImageAxes> axes = axes_at(values, context);
  if (!axes) return tl::unexpected(axes.error());
  const CosSin direction = cos_sin_of_deg(values.at("direction_deg"));
  const CosSin approach = cos_sin_of_deg(values.at("approach_angle_deg"));
  const glm::dvec3 across = direction.cos * axes->right + direction.sin * axes->up;
  const std::optional<double> course_deg = value_of(values, "course_deg");
  const glm::dvec3 velocity_mps =
      course_deg ? velocity_over_ground(values, *course_deg, context)
                 : values.at("relative_speed_mps") * (approach.cos * across - approach.sin * axes->ray);
  const glm::dvec3 there_m = distance_m * axes->ray;
  const double length_s = ends_of(context).length_s;
  return motion_over_time(
      {rounded(there_m - since_first_s * velocity_mps), rounded(there_m + (length_s - since_first_s) * velocity_mps)},
      length_s);
}

std::vector<WaypointSettings> waypoints_of(const RelativeMotion& motion, const FlightContext& context) {
  const FlightEnds ends = ends_of(context);
  std::vector<WaypointSettings> waypoints;
  for (const auto& [frame, since_s] : {std::pair{ends.frames.first, 0.0}, std::pair{ends.frames.last, ends.length_s}})
    waypoints.push_back(
        {.frame = frame, .position_m = camera_position_m(context, ends.first_s + since_s) + motion.at(since_s)});
  return waypoints;
}

// The distance at which the intruder is as large as asked: a silhouette's size is nearly inverse to the distance, so
// that few rounds lead to a distance that, rounded to 2^-10 m, stays: every machine finds the same.
Possible<RelativeMotion> positioned_motion(const FlightValues& values, const FlightContext& context,
                                           FlightValues& derived) {
  constexpr int kRounds = 8;
  constexpr double kMaxError = 0.01;  // of the size
  const std::optional<int> frame = frame_of_position(values, context);
  if (!frame)
    return tl::unexpected(fmt::format("time_s: {} s is after the video's last frame, at {} s",
                                      short_number_text(values.at("time_s")),
                                      short_number_text(ends_of(context).length_s)));
  const double since_first_s = time_of_frame_s(context.footage, *frame) - ends_of(context).first_s;
  if (const std::optional<double> given_m = value_of(values, "distance_m"))
    return motion_at_distance(values, context, since_first_s, std::round(*given_m * 1024) / 1024);
  double distance_m = 100;
  double error = 1;
  Possible<RelativeMotion> motion = tl::unexpected(std::string());
  for (int round = 0; round <= kRounds; ++round) {
    motion = motion_at_distance(values, context, since_first_s, distance_m);
    if (!motion) return motion;
    const std::optional<double> size_px =
        context.size_px_on ? context.size_px_on(waypoints_of(*motion, context), *frame) : std::nullopt;
    if (!size_px || !(*size_px > 0))
      return tl::unexpected(std::string("size_px: the intruder's model has no image there"));
    error = *size_px / values.at("size_px") - 1;
    if (round == kRounds) break;
    const double next_m = std::clamp(std::round(distance_m * (1 + error) * 1024) / 1024, 0.02, kMaxCoordinate_m / 10);
    if (std::exchange(distance_m, next_m) == next_m) break;  // so would all further rounds be
  }
  if (std::abs(error) > kMaxError)
    return tl::unexpected(fmt::format("size_px: the intruder cannot be {} px large there; it comes to {} px",
                                      short_number_text(values.at("size_px")),
                                      short_number_text(values.at("size_px") * (1 + error))));
  derived["distance_m"] = distance_m;
  return motion;
}

// What determines the intruder's speed.
std::string ways_out(FlightKind kind, const FlightValues& values) {
  if (kind == FlightKind::image_position)
    return values.contains("course_deg") ? "relative_speed_mps, course_deg or climb_deg"
                                         : "relative_speed_mps, direction_deg or approach_angle_deg";
  if (kind == FlightKind::encounter)
    return values.contains("closing_speed_mps") ? "closing_speed_mps or bearing_deg"
                                                : "range_m, time_of_closest_approach_s or bearing_deg";
  if (values.contains("speed_mps")) return "speed_mps";
  return is_crossing(kind) ? "distance_m or frames" : "from_distance_m, to_distance_m or frames";
}

// The quantities on which the height depends.
const char* heights_of(FlightKind kind, const FlightValues& values) {
  if (kind == FlightKind::image_position)
    return values.contains("distance_m") ? "y_percent, distance_m" : "y_percent, size_px";
  return kind == FlightKind::encounter ? "elevation_deg, miss_angle_deg" : "from_y_percent, to_y_percent";
}

Possible<RelativeMotion> motion_of(FlightKind kind, const FlightValues& values, const FlightContext& context,
                                   FlightValues& derived) {
  if (kind == FlightKind::image_position) return positioned_motion(values, context, derived);
  if (kind != FlightKind::encounter) return template_motion(kind, values, context);
  const Possible<Encounter> encounter = encounter_of(values, ends_of(context));
  if (!encounter) return tl::unexpected(encounter.error());
  add_derived(*encounter, derived);
  return relative_motion(*encounter);
}

}  // namespace

FlightEnds ends_of(const FlightContext& context) {
  const FrameRange frames{context.frames.first, std::max(context.frames.last, context.frames.first + 1)};
  const double first_s = time_of_frame_s(context.footage, frames.first);
  return {frames, first_s, time_of_frame_s(context.footage, frames.last) - first_s};
}

std::optional<int> frame_of_position(const FlightValues& values, const FlightContext& context) {
  const FrameRange& frames = context.frames;
  const std::optional<double> time_s = value_of(values, "time_s");
  if (!time_s) return frames.first + (frames.last - frames.first) / 2;
  const double first_s = time_of_frame_s(context.footage, frames.first);
  int nearest = frames.first;
  const auto off_s = [&](int frame) { return std::abs(time_of_frame_s(context.footage, frame) - first_s - *time_s); };
  for (int frame = frames.first; frame <= frames.last; ++frame)
    if (off_s(frame) < off_s(nearest)) nearest = frame;
  const double frame_s = ends_of(context).length_s / std::max(1, ends_of(context).frames.last - frames.first);
  return off_s(nearest) <= frame_s ? std::optional(nearest) : std::nullopt;
}

glm::dvec3 camera_position_m(const FlightContext& context, double time_s) {
  return context.camera.position_m + time_s * camera_velocity_mps(context);
}

Possible<void> check_speed(double speed_mps, const FlightContext& context, const std::string& change) {
  const std::optional<Span>& limits = context.speed_limits_mps;
  if (!limits || (speed_mps >= limits->low && speed_mps <= limits->high)) return {};
  return tl::unexpected(fmt::format(
      "speed_mps: the intruder would have to fly {} m/s; its aircraft flies {} to {}; change {}, or the "
      "aircraft's speed_limits_mps",
      short_number_text(speed_mps), short_number_text(limits->low), short_number_text(limits->high), change));
}

Possible<void> check_waypoint(const WaypointSettings& waypoint, const char* height) {
  const glm::dvec3& p_m = waypoint.position_m;
  const std::string frame = fmt::format(" in frame {}", std::lround(*waypoint.frame));
  if (p_m.z > kRounding_m)
    return tl::unexpected(
        fmt::format("{}: the intruder is underground{}, {} m below z = 0", height, frame, short_number_text(p_m.z)));
  if (glm::max(glm::max(std::abs(p_m.x), std::abs(p_m.y)), std::abs(p_m.z)) > kMaxCoordinate_m)
    return tl::unexpected("the intruder is farther than 1e8 m from the world's origin" + frame);
  return {};
}

Possible<PlannedFlight> planned_flight(FlightKind kind, const FlightValues& values, const FlightContext& context) {
  if (const Possible<void> checked = check_values(kind, values); !checked) return tl::unexpected(checked.error());
  const FlightEnds ends = ends_of(context);
  if (!(ends.length_s > 0)) return tl::unexpected(std::string("frames: the footage's times do not increase"));
  if (kind == FlightKind::encounter_model || kind == FlightKind::recorded)
    return planned_track_flight(kind, values, context);
  PlannedFlight flight;
  const Possible<RelativeMotion> motion = motion_of(kind, values, context, flight.derived);
  if (!motion) return tl::unexpected(motion.error());
  const double speed_mps = glm::length(motion->velocity_mps + camera_velocity_mps(context));
  if (const Possible<void> checked = check_speed(speed_mps, context, ways_out(kind, values)); !checked)
    return tl::unexpected(checked.error());
  flight.waypoints = waypoints_of(*motion, context);
  for (const WaypointSettings& waypoint : flight.waypoints)
    if (const Possible<void> checked = check_waypoint(waypoint, heights_of(kind, values)); !checked)
      return tl::unexpected(checked.error());
  flight.derived["speed_mps"] = speed_mps;
  flight.derived["nearest_m"] = min_range_m(*motion, ends.length_s);
  return flight;
}

glm::dvec3 ray_of_place(const Camera& camera, const glm::dvec2& place_percent) {
  const glm::dvec2 size_px(camera.size_px.width, camera.size_px.height);
  const glm::dvec2 wanted_px = place_percent / 100.0 * size_px - 0.5;
  if (const std::optional<glm::dvec3> ray = near_ray(camera.lens, wanted_px)) return *ray;
  const glm::dvec3 axis(1, 0, 0);
  const std::optional<glm::dvec2> axis_px = camera.lens.pixel(axis);
  if (!axis_px) return axis;
  glm::dvec3 best = axis;
  double low = 0, high = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    const std::optional<glm::dvec3> ray = near_ray(camera.lens, *axis_px + middle * (wanted_px - *axis_px));
    if (ray) best = *ray;
    (ray ? low : high) = middle;
  }
  return best;
}

}  // namespace sigs
