// SPDX-License-Identifier: MIT
#include "editor/views/encounter/approach_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/document/waypoint_edits.h"
#include "editor/views/waypoint_actions.h"
#include "encounter/encounter.h"
#include "project/places.h"
#include "scene/encounter_tracks.h"

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
  const Result<NearestMoment> nearest = nearest_horizontal_moment(own, flight);
  if (!nearest) return std::nullopt;
  PresentApproach present{.own = own.at(nearest->time_s), .intruder = flight.at(nearest->time_s)};
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

tl::expected<std::vector<WaypointSettings>, std::string> moved_together(const ApproachStart& start,
                                                                        const PlannedApproach& wanted) {
  const PresentApproach& present = start.present;
  const glm::dvec3 by_m = intruder_at(wanted, present.own).position_m - present.intruder.position_m;
  EncounterTrack moved = start.flight;
  moved.at = [&](double time_s) {
    AircraftState state = start.flight.at(time_s);
    state.position_m += by_m;
    return state;
  };
  const Result<NearestMoment> nearest = nearest_horizontal_moment(start.own, moved);
  if (!nearest) return tl::unexpected(nearest.error().what);
  if (std::abs(nearest->time_s - wanted.time_s) > kSameMoment_s &&
      nearest->horizontal_m < std::abs(wanted.miss_m) - kStraight_m)
    return tl::unexpected(
        fmt::format("horizontal miss: both flights curve, so that the intruder would come nearer at "
                    "{:.3f} s, {:.2f} m",
                    nearest->time_s, nearest->horizontal_m));
  std::vector<WaypointSettings> waypoints = start.plan.waypoints;
  for (WaypointSettings& waypoint : waypoints) {
    const glm::dvec3 at_m = waypoint.position_m + by_m;
    if (glm::any(glm::greaterThan(glm::abs(at_m), glm::dvec3(kFarthestApproach_m))))
      return tl::unexpected(std::string("miss: the flight leaves the world, which ends 1e8 m from its origin"));
    put_at(waypoint, at_m, start.earth);
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

}  // namespace

std::optional<PresentApproach> present_approach(const ViewContext& context, int intruder) {
  const std::optional<int> in_scene = scene_intruder(context, intruder);
  if (!in_scene) return std::nullopt;
  const Scene& scene = *shown_scene(context);
  return approach_between(encounter_track_of_camera(scene),
                          encounter_track_of_intruder(scene, static_cast<std::size_t>(*in_scene)), scene.footage);
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
  const double first = scene.first_frame;
  const double last = std::max(scene.last_frame, scene.first_frame + 1);
  ApproachStart start{.intruder = intruder,
                      .own = encounter_track_of_camera(scene),
                      .flight = encounter_track_of_intruder(scene, static_cast<std::size_t>(*in_scene)),
                      .plan = context.project().intruders[static_cast<std::size_t>(intruder)].trajectory,
                      .first_frame = first,
                      .last_frame = last,
                      .first_s = time_of_frame_s(scene.footage, first),
                      .last_s = time_of_frame_s(scene.footage, last),
                      .earth = stated_frame(context.project().geo)};
  const std::optional<PresentApproach> present = approach_between(start.own, start.flight, scene.footage);
  if (!present || start.plan.waypoints.empty() || !(start.last_s > start.first_s)) return std::nullopt;
  start.present = *present;
  return start;
}

tl::expected<std::vector<WaypointSettings>, std::string> waypoints_for(const ApproachStart& start,
                                                                       const PlannedApproach& wanted) {
  const PresentApproach& present = start.present;
  const bool has_direction = present.is_within && present.approach.closing_speed_mps > 0;
  return has_direction && keeps_motion(present.approach, wanted) ? moved_together(start, wanted)
                                                                 : straight(start, wanted);
}

std::string change_approach(const ViewContext& context, const ApproachStart& start, const PlannedApproach& wanted,
                            const std::string& gesture) {
  tl::expected<std::vector<WaypointSettings>, std::string> waypoints = waypoints_for(start, wanted);
  if (!waypoints) return waypoints.error();
  context.edits.change(
      "change closest approach",
      [intruder = static_cast<std::size_t>(start.intruder), waypoints = std::move(*waypoints)](Project& project) {
        project.intruders[intruder].trajectory.waypoints = waypoints;
      },
      gesture);
  return {};
}

std::string misses_text(const PlannedApproach& approach) {
  return fmt::format("{:.1f} m to the {}, {:.1f} m {}", std::abs(approach.miss_m),
                     approach.miss_m < 0 ? "left" : "right", std::abs(approach.vertical_miss_m),
                     approach.vertical_miss_m < 0 ? "below" : "above");
}

}  // namespace sigs::editor
