// SPDX-License-Identifier: MIT
#include "encounter/planned_approach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "encounter/encounter.h"

namespace sigs {

namespace {

// Distances that differ by less are the same approach.
constexpr double kSameDistance_m = 1e-6;

// Unit vector of the ownship's course over ground.
glm::dvec2 course_of(const AircraftState& own) {
  const glm::dvec2 velocity(own.velocity_mps);
  const double speed_mps = std::hypot(velocity.x, velocity.y);
  return speed_mps < kHover_mps ? glm::dvec2(1, 0) : velocity / speed_mps;
}

// Turned clockwise as seen from above: Z points down, so from X towards Y.
glm::dvec2 turned_right(const glm::dvec2& v, double angle_rad) {
  const double cos = std::cos(angle_rad);
  const double sin = std::sin(angle_rad);
  return {cos * v.x - sin * v.y, sin * v.x + cos * v.y};
}

glm::dvec2 right_of(const glm::dvec2& v) {
  return {-v.y, v.x};
}

bool all_finite(const PlannedApproach& a) {
  return std::isfinite(a.time_s) && std::isfinite(a.miss_m) && std::isfinite(a.vertical_miss_m) &&
         std::isfinite(a.closing_speed_mps) && std::isfinite(a.climb_mps) && std::isfinite(a.bearing_rad);
}

std::string number(double value) {
  return short_number_text(std::round(value * 1000) / 1000);
}

// What the ownship's own acceleration asks for: |v|^2 + s.(a_intruder - a_own) > 0, or the distance is greatest there.
double min_closing_speed_mps(const PlannedApproach& approach, const EncounterTrack& own) {
  constexpr double kStep_s = 1e-3;
  const double before_s = std::max(own.first_s, approach.time_s - kStep_s);
  const double after_s = std::min(own.last_s, approach.time_s + kStep_s);
  if (!(after_s > before_s)) return 0;
  const AircraftState state = own.at(approach.time_s);
  const glm::dvec2 acceleration_mps2 =
      glm::dvec2(own.at(after_s).velocity_mps - own.at(before_s).velocity_mps) / (after_s - before_s);
  const glm::dvec2 miss_m(intruder_at(approach, state).position_m - state.position_m);
  return std::sqrt(std::max(0.0, glm::dot(miss_m, acceleration_mps2)));
}

// "": it can be tried.
std::string why_not(const PlannedApproach& approach, const EncounterTrack& own) {
  if (!all_finite(approach)) return "a number is not finite";
  if (approach.time_s < own.first_s || approach.time_s > own.last_s)
    return fmt::format("time: {} s is outside of the clip, {} to {} s", number(approach.time_s), number(own.first_s),
                       number(own.last_s));
  if (approach.closing_speed_mps > 0) return {};
  if (approach.closing_speed_mps == 0 && approach.climb_mps != 0)
    return "closing speed: above 0 is needed; with vertical motion alone the horizontal distance stays the same, so no "
           "time is the closest approach";
  return "closing speed: above 0 is needed, or the intruder never comes nearer";
}

std::string why_nearer(const PlannedApproach& approach, const EncounterTrack& own, const NearestMoment& nearest) {
  const double min_mps = min_closing_speed_mps(approach, own);
  if (approach.closing_speed_mps <= min_mps)
    return fmt::format("closing speed: above {} m/s is needed, as the camera itself speeds towards the intruder then",
                       number(std::ceil(min_mps * 1000) / 1000));
  return fmt::format("closing speed: {} m/s is too little for the camera's turns, which bring it to {} m at {} s",
                     number(approach.closing_speed_mps), number(nearest.horizontal_m), number(nearest.time_s));
}

bool is_near_origin(const glm::dvec3& place_m) {
  return std::max({std::abs(place_m.x), std::abs(place_m.y), std::abs(place_m.z)}) <= kFarthestApproach_m;
}

}  // namespace

AircraftState intruder_at(const PlannedApproach& approach, const AircraftState& own) {
  const glm::dvec2 toward = turned_right(course_of(own), approach.bearing_rad);
  const glm::dvec2 miss_m = approach.miss_m * right_of(toward);
  const glm::dvec2 velocity_mps = -approach.closing_speed_mps * toward;
  return {own.position_m + glm::dvec3(miss_m, -approach.vertical_miss_m),
          own.velocity_mps + glm::dvec3(velocity_mps, -approach.climb_mps)};
}

PlannedApproach approach_of(const AircraftState& own, const AircraftState& intruder, double time_s) {
  const RelativeState relative = relative_state(own, intruder);
  const glm::dvec2& s_m = relative.horizontal_m;
  const double speed_mps = std::hypot(relative.horizontal_mps.x, relative.horizontal_mps.y);
  const double distance_m = std::hypot(s_m.x, s_m.y);
  const glm::dvec2 course = course_of(own);
  glm::dvec2 toward = course;
  if (speed_mps > 0)
    toward = -relative.horizontal_mps / speed_mps;
  else if (distance_m > 0)
    toward = -right_of(s_m / distance_m);
  const glm::dvec2 right = right_of(toward);
  return {.time_s = time_s,
          .miss_m = std::copysign(distance_m, s_m.x * right.x + s_m.y * right.y),
          .vertical_miss_m = relative.vertical_m,
          .closing_speed_mps = speed_mps,
          .climb_mps = relative.vertical_mps,
          .bearing_rad = std::atan2(course.x * toward.y - course.y * toward.x, glm::dot(course, toward))};
}

tl::expected<EncounterTrack, std::string> planned_flight_of(const PlannedApproach& approach,
                                                            const EncounterTrack& own) {
  if (std::string reason = why_not(approach, own); !reason.empty()) return tl::unexpected(std::move(reason));
  const AircraftState closest = intruder_at(approach, own.at(approach.time_s));
  EncounterTrack flight{
      .name = "intruder",
      .first_s = own.first_s,
      .last_s = own.last_s,
      .at = [closest, time_s = approach.time_s](double t_s) {
        return AircraftState{closest.position_m + (t_s - time_s) * closest.velocity_mps, closest.velocity_mps};
      }};
  for (const double end_s : {flight.first_s, flight.last_s})
    if (!is_near_origin(flight.at(end_s).position_m))
      return tl::unexpected(
          std::string("miss or speed: the flight leaves the world, which ends 1e8 m from its origin"));
  const Result<NearestMoment> nearest = nearest_horizontal_moment(own, flight);
  if (!nearest) return tl::unexpected(nearest.error().what);
  if (nearest->horizontal_m < std::abs(approach.miss_m) - kSameDistance_m)
    return tl::unexpected(why_nearer(approach, own, *nearest));
  return flight;
}

}  // namespace sigs
