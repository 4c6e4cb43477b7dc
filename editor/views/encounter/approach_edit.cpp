// SPDX-License-Identifier: MIT
#include "editor/views/encounter/approach_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/document/project_edits.h"
#include "editor/views/waypoint_actions.h"
#include "project/places.h"
#include "scene/flight.h"
#include "scene/scene_parts.h"

namespace sigs::editor {

namespace {

constexpr double kStraight_m = 1e-3;
constexpr double kSameMoment_s = 1e-3;
constexpr int kInstants = 32;  // at which a flight is compared with a straight one

// Whether the horizontal distance neither rises nor falls there, so that it is not least by the clip's end alone.
bool is_beside(const RelativeState& r) {
  const double product = r.horizontal_m.x * r.horizontal_mps.x + r.horizontal_m.y * r.horizontal_mps.y;
  const double size =
      std::hypot(r.horizontal_m.x, r.horizontal_m.y) * std::hypot(r.horizontal_mps.x, r.horizontal_mps.y);
  return std::abs(product) <= 1e-6 * size + 1e-9;
}

bool flies_straight(const EncounterTrack& flight, const AircraftState& state, double time_s) {
  for (int i = 0; i <= kInstants; ++i) {
    const double t_s = std::lerp(flight.first_s, flight.last_s, static_cast<double>(i) / kInstants);
    const glm::dvec3 straight_m = state.position_m + (t_s - time_s) * state.velocity_mps;
    if (glm::distance(flight.at(t_s).position_m, straight_m) > kStraight_m) return false;
  }
  return true;
}

std::optional<PresentApproach> approach_between(const EncounterTrack& own, const EncounterTrack& flight,
                                                const FootageShape& footage) {
  const Result<NearestMoments> moments = nearest_moments(own, flight);
  if (!moments) return std::nullopt;
  const NearestMoment* const nearest = &moments->horizontal;
  PresentApproach present{.own = own.at(nearest->time_s), .intruder = flight.at(nearest->time_s)};
  present.nearest_3d = moments->slant;
  present.approach = approach_of(present.own, present.intruder, nearest->time_s);
  present.frame = frame_at_time(footage, nearest->time_s);
  present.is_within = is_beside(relative_state(present.own, present.intruder));
  present.is_straight = flies_straight(flight, present.intruder, nearest->time_s);
  return present;
}

// Only the misses are others.
bool keeps_motion(const PlannedApproach& a, const PlannedApproach& b) {
  return a.time_s == b.time_s && a.closing_speed_mps == b.closing_speed_mps && a.climb_mps == b.climb_mps &&
         a.bearing_rad == b.bearing_rad;
}

// How a flight is changed: every position of it, and when it is there.
struct FlightChange {
  double delay_s = 0;
  double turn_rad = 0;  // about the vertical, as yaw, around `from_m`
  glm::dvec3 from_m{0, 0, 0};
  glm::dvec3 to_m{0, 0, 0};  // where `from_m` comes to lie
  double at_s = 0;           // when it is there
  glm::dvec3 added_mps{0, 0, 0};

  [[nodiscard]] glm::dvec3 turned(const glm::dvec3& v) const {
    const double cos = std::cos(turn_rad);
    const double sin = std::sin(turn_rad);
    return {cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z};
  }
  // time_s is that of the changed flight.
  [[nodiscard]] glm::dvec3 position(const glm::dvec3& before_m, double time_s) const {
    return to_m + turned(before_m - from_m) + (time_s - at_s) * added_mps;
  }
};

double course_of(const glm::dvec3& velocity_mps) {
  return std::atan2(velocity_mps.y, velocity_mps.x);
}

bool has_course(const glm::dvec3& velocity_mps) {
  return std::hypot(velocity_mps.x, velocity_mps.y) >= kHover_mps;
}

FlightChange change_to(const ApproachStart& start, const PlannedApproach& wanted) {
  const PresentApproach& present = start.present;
  const AircraftState there = intruder_at(wanted, start.own.at(wanted.time_s));
  FlightChange change{.delay_s = wanted.time_s - present.approach.time_s,
                      .from_m = present.intruder.position_m,
                      .to_m = there.position_m,
                      .at_s = wanted.time_s};
  if (present.is_within && keeps_motion(present.approach, wanted)) return change;  // moved as a whole
  if (has_course(present.intruder.velocity_mps) && has_course(there.velocity_mps))
    change.turn_rad = course_of(there.velocity_mps) - course_of(present.intruder.velocity_mps);
  change.added_mps = there.velocity_mps - change.turned(present.intruder.velocity_mps);
  return change;
}

EncounterTrack changed_flight(const EncounterTrack& flight, const FlightChange& change) {
  EncounterTrack changed = flight;
  for (double& knot_s : changed.knots_s) knot_s += change.delay_s;
  changed.at = [at = flight.at, change](double time_s) {
    const AircraftState before = at(time_s - change.delay_s);
    return AircraftState{change.position(before.position_m, time_s),
                         change.turned(before.velocity_mps) + change.added_mps};
  };
  return changed;
}

std::string why_not_nearest(const NearestMoment& nearest, const PlannedApproach& wanted) {
  const bool is_later = std::abs(nearest.time_s - wanted.time_s) > kSameMoment_s;
  if (!is_later || nearest.horizontal_m >= std::abs(wanted.miss_m) - kStraight_m) return "";
  return fmt::format(
      "horizontal miss: both flights curve, so that the intruder would come nearer at {:.3f} s, {:.2f} m",
      nearest.time_s, nearest.horizontal_m);
}

tl::expected<std::vector<WaypointSettings>, std::string> curved(const ApproachStart& start,
                                                                const PlannedApproach& wanted) {
  const FlightChange change = change_to(start, wanted);
  const Result<NearestMoment> nearest = nearest_horizontal_moment(start.own, changed_flight(start.flight, change));
  if (!nearest) return tl::unexpected(nearest.error().what);
  if (std::string reason = why_not_nearest(*nearest, wanted); !reason.empty()) return tl::unexpected(std::move(reason));
  std::vector<WaypointSettings> waypoints = start.plan.waypoints;
  const std::vector<double> frames =
      waypoint_frames(waypoints, static_cast<int>(start.first_frame), static_cast<int>(start.last_frame));
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const double time_s = time_of_frame_s(start.footage, frames[i]) + change.delay_s;
    if (change.delay_s != 0) waypoints[i].frame = frame_at_time(start.footage, time_s);
    const glm::dvec3 at_m = change.position(waypoints[i].position_m, time_s);
    if (glm::any(glm::greaterThan(glm::abs(at_m), glm::dvec3(kFarthestApproach_m))))
      return tl::unexpected(std::string("miss: the flight leaves the world, which ends 1e8 m from its origin"));
    put_at(waypoints[i], at_m, start.earth);
  }
  return waypoints;
}

tl::expected<std::vector<WaypointSettings>, std::string> straight(const ApproachStart& start,
                                                                  const PlannedApproach& wanted) {
  const tl::expected<EncounterTrack, std::string> flight = planned_flight_of(wanted, start.own);
  if (!flight) return tl::unexpected(flight.error());
  std::vector<WaypointSettings> waypoints{start.plan.waypoints.front(), start.plan.waypoints.back()};
  waypoints[0].frame = start.first_frame;
  waypoints[1].frame = start.last_frame;
  put_at(waypoints[0], flight->at(start.first_s).position_m, start.earth);
  put_at(waypoints[1], flight->at(start.last_s).position_m, start.earth);
  return waypoints;
}

std::string put_waypoints(const ViewContext& context, const char* name, const ApproachStart& start,
                          tl::expected<std::vector<WaypointSettings>, std::string> waypoints,
                          const std::string& gesture) {
  if (!waypoints) return waypoints.error();
  context.edits.change(
      name,
      [intruder = static_cast<std::size_t>(start.intruder), waypoints = std::move(*waypoints)](Project& project) {
        project.intruders[intruder].trajectory.waypoints = waypoints;
      },
      gesture);
  return {};
}

// The waypoints of the flight that has this closest approach. Where only the misses differ from what is there, all
// waypoints move together. Otherwise a straight flight gets two waypoints, in the first frame and in the last one, and
// a curve stays a curve with its waypoints: the flight is moved in time with its closest approach, turned about the
// vertical as its course there is, and has a constant velocity added, so that its turns keep their accelerations.
// Where there is no such flight: the reason in one line that begins with the quantity.
tl::expected<std::vector<WaypointSettings>, std::string> waypoints_for(const ApproachStart& start,
                                                                       const PlannedApproach& wanted) {
  const PresentApproach& present = start.present;
  const bool has_direction = present.is_within && present.approach.closing_speed_mps > 0;
  if (has_direction && keeps_motion(present.approach, wanted)) return curved(start, wanted);
  // The flight as planned by numbers alone says why there can be none at all.
  tl::expected<std::vector<WaypointSettings>, std::string> plain = straight(start, wanted);
  const bool is_curve = !present.is_straight && start.plan.waypoints.size() > 2 &&
                        start.plan.timing == Timing::frames && start.plan.spline == SplineKind::interpolating;
  return plain && is_curve ? curved(start, wanted) : plain;
}

}  // namespace

std::optional<PresentApproach> present_approach(const ViewContext& context, int intruder) {
  const std::optional<int> in_scene = scene_intruder(context, intruder);
  if (!in_scene) return std::nullopt;
  const Scene& scene = *shown_scene(context);
  return approach_between(encounter_track_of_camera(scene),
                          encounter_track_of_intruder(scene, static_cast<std::size_t>(*in_scene)),
                          counted_frames(scene).footage);
}

const PresentApproach* PresentApproachMemory::of(const ViewContext& context, int intruder) {
  if (context.shown.scene != scene_ || intruder != intruder_) {
    scene_ = context.shown.scene;
    intruder_ = intruder;
    found_ = present_approach(context, intruder);
  }
  return found_ ? &*found_ : nullptr;
}

std::optional<ApproachStart> approach_start(const ViewContext& context, int intruder) {
  const std::optional<int> in_scene = scene_intruder(context, intruder);
  if (!in_scene || context.shown.scene->revision != context.document.revision().number) return std::nullopt;
  const Scene& scene = *shown_scene(context);
  const CountedFrames counted = counted_frames(scene);
  const double first = counted.first_frame;
  const double last = std::max(counted.last_frame, counted.first_frame + 1);
  ApproachStart start{.intruder = intruder,
                      .own = encounter_track_of_camera(scene),
                      .flight = encounter_track_of_intruder(scene, static_cast<std::size_t>(*in_scene)),
                      .plan = context.project().intruders[static_cast<std::size_t>(intruder)].trajectory,
                      .first_frame = first,
                      .last_frame = last,
                      .first_s = time_of_frame_s(counted.footage, first),
                      .last_s = time_of_frame_s(counted.footage, last),
                      .earth = stated_frame(context.project().geo),
                      .footage = counted.footage};
  const std::optional<PresentApproach> present = approach_between(start.own, start.flight, counted.footage);
  if (!present || start.plan.waypoints.empty() || !(start.last_s > start.first_s)) return std::nullopt;
  start.present = *present;
  return start;
}

tl::expected<PlannedApproach, std::string> approach_at_distance(const ApproachStart& start, double distance_m) {
  const PlannedApproach& from = start.present.approach;
  const auto scaled_by = [&](double factor) {
    PlannedApproach approach = from;
    approach.miss_m *= factor;
    approach.vertical_miss_m *= factor;
    if (from.miss_m == 0 && from.vertical_miss_m == 0) approach.miss_m = factor;
    return approach;
  };
  const auto distance_of = [&](double factor) {
    const Result<NearestMoments> nearest =
        nearest_moments(start.own, changed_flight(start.flight, change_to(start, scaled_by(factor))));
    return nearest ? nearest->slant.range_m : HUGE_VAL;
  };
  // The distance rises with the factor from some factor on: bracketed, then halved.
  double low = 0;
  double high = 1;
  while (high < 1e9 && !(distance_of(high) >= distance_m)) high *= 2;
  constexpr int kHalvings = 44;
  for (int i = 0; i < kHalvings; ++i) (distance_of((low + high) / 2) < distance_m ? low : high) = (low + high) / 2;
  if (!(std::abs(distance_of(high) - distance_m) <= kStraight_m))
    return tl::unexpected(fmt::format("closest distance: {:.2f} m is the least with these flights", distance_of(0)));
  return scaled_by(high);
}

std::string change_approach(const ViewContext& context, const ApproachStart& start, const PlannedApproach& wanted,
                            const std::string& gesture) {
  return put_waypoints(context, "change closest approach", start, waypoints_for(start, wanted), gesture);
}

std::string make_straight(const ViewContext& context, const ApproachStart& start) {
  return put_waypoints(context, "make flight straight", start, straight(start, start.present.approach), "");
}

std::string misses_text(const PlannedApproach& approach) {
  return fmt::format("{:.1f} m to the {}, {:.1f} m {}", std::abs(approach.miss_m),
                     approach.miss_m < 0 ? "left" : "right", std::abs(approach.vertical_miss_m),
                     approach.vertical_miss_m < 0 ? "below" : "above");
}

}  // namespace sigs::editor
