// SPDX-License-Identifier: MIT
#include "encounter_model/model_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pose.h"
#include "base/text.h"

namespace sigs {

namespace {

constexpr double kMinRelativeSpeed_mps = 1e-6;

glm::dvec2 direction_ne(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

// The direction 90 degrees clockwise, seen from above.
glm::dvec2 right_of(glm::dvec2 north_east) {
  return {-north_east.y, north_east.x};
}

glm::dvec2 velocity_ne_mps(const SampledPoint& point) {
  return point.speed_mps * direction_ne(point.heading_rad);
}

glm::dvec2 acceleration_ne_mps2(const SampledPoint& point) {
  const glm::dvec2 ahead = direction_ne(point.heading_rad);
  if (point.speed_mps <= 0 && point.acceleration_mps2 <= 0) return {0, 0};
  return point.acceleration_mps2 * ahead + point.speed_mps * point.turn_rate_radps * right_of(ahead);
}

Result<void> check(const ModelFlight& ownship, const ModelFlight& intruder, const ApproachRequest& approach) {
  for (const auto& [name, number] : {std::pair("time", approach.time_s), std::pair("hmd", approach.hmd_m),
                                     std::pair("vmd", approach.vmd_m), std::pair("bearing", approach.bearing_rad)})
    if (!std::isfinite(number)) return fail(name, "is not a finite number");
  const double end_s = std::min(ownship.duration_s(), intruder.duration_s());
  if (approach.time_s < 0 || approach.time_s > end_s)
    return fail("time", fmt::format("{} s is not within both tracks, 0 to {} s", short_number_text(approach.time_s),
                                    short_number_text(end_s)));
  return {};
}

// Speed of the relative motion with which the intruder comes from the bearing. With u the direction of the relative
// velocity, |ownship's velocity + k u| is the intruder's speed: a quadratic equation for k, of which this is the
// greater root.
Result<double> closing_speed_mps(const SampledPoint& own, const SampledPoint& other, double bearing_rad) {
  const double across_mps = own.speed_mps * std::sin(bearing_rad);
  const double radicand = (other.speed_mps - std::abs(across_mps)) * (other.speed_mps + std::abs(across_mps));
  const double rounding = 1e-12 * own.speed_mps * own.speed_mps;
  const double speed_mps = own.speed_mps * std::cos(bearing_rad) + std::sqrt(std::max(0.0, radicand));
  if (radicand < -rounding || speed_mps < kMinRelativeSpeed_mps)
    return fail("bearing", fmt::format("at {} deg an intruder of {} m/s does not come closer to an ownship of {} m/s",
                                       short_number_text(deg_of_rad(bearing_rad)), short_number_text(other.speed_mps),
                                       short_number_text(own.speed_mps)));
  return speed_mps;
}

// By how much the intruder's track is turned to the right.
double turned_by_rad(const SampledPoint& own, const SampledPoint& other, double bearing_rad, double closing_mps) {
  if (other.speed_mps <= 0) return 0;  // it hovers: any heading will do
  const glm::dvec2 velocity_mps = velocity_ne_mps(own) - closing_mps * direction_ne(own.heading_rad + bearing_rad);
  return std::atan2(velocity_mps.y, velocity_mps.x) - other.heading_rad;
}

SampledPoint turned(SampledPoint point, double by_rad, const glm::dvec3& centre_neu_m) {
  const glm::dvec3 from_centre_m = point.position_neu_m - centre_neu_m;
  const double c = std::cos(by_rad);
  const double s = std::sin(by_rad);
  point.position_neu_m = centre_neu_m + glm::dvec3(c * from_centre_m.x - s * from_centre_m.y,
                                                   s * from_centre_m.x + c * from_centre_m.y, from_centre_m.z);
  point.heading_rad += by_rad;
  return point;
}

// The state at a time by what holds before it: at whole seconds that may change.
SampledPoint until_time(const ModelFlight& track, double time_s) {
  const auto second = static_cast<std::size_t>(std::max(0.0, std::ceil(time_s) - 1));
  const SampledPoint& before = track.points[second];
  return moved_on(before, time_s - before.time_s);
}

// Half the second derivative of the square of the horizontal range, in m^2/s^2: positive at a minimum.
double curvature(const SampledPoint& own, const SampledPoint& other) {
  const glm::dvec2 velocity_mps = velocity_ne_mps(other) - velocity_ne_mps(own);
  const glm::dvec2 offset_m(other.position_neu_m - own.position_neu_m);
  return glm::dot(velocity_mps, velocity_mps) +
         glm::dot(offset_m, acceleration_ne_mps2(other) - acceleration_ne_mps2(own));
}

bool is_least_range(const ModelFlight& ownship, const ModelFlight& intruder, double time_s) {
  return curvature(at_time(ownship, time_s), at_time(intruder, time_s)) > 0 &&
         curvature(until_time(ownship, time_s), until_time(intruder, time_s)) > 0;
}

// Where the intruder is at the closest approach, once it is turned.
glm::dvec3 place_neu_m(const SampledPoint& own, const SampledPoint& turned_intruder, const ApproachRequest& approach) {
  const glm::dvec2 relative_mps = velocity_ne_mps(turned_intruder) - velocity_ne_mps(own);
  const glm::dvec2 offset_m = approach.hmd_m * right_of(-glm::normalize(relative_mps));
  return own.position_neu_m + glm::dvec3(offset_m, approach.vmd_m);
}

}  // namespace

Result<ModelFlight> placed_intruder(const ModelFlight& ownship, const ModelFlight& intruder,
                                    const ApproachRequest& approach) {
  if (const Result<void> good = check(ownship, intruder, approach); !good) return fail(good.error());
  const SampledPoint own = at_time(ownship, approach.time_s);
  const SampledPoint other = at_time(intruder, approach.time_s);
  const Result<double> closing_mps = closing_speed_mps(own, other, approach.bearing_rad);
  if (!closing_mps) return fail(closing_mps.error());
  const double by_rad = turned_by_rad(own, other, approach.bearing_rad, *closing_mps);
  const glm::dvec3 place_m = place_neu_m(own, turned(other, by_rad, other.position_neu_m), approach);
  ModelFlight placed = intruder;
  for (SampledPoint& point : placed.points) {
    point = turned(point, by_rad, other.position_neu_m);
    point.position_neu_m += place_m - other.position_neu_m;
  }
  if (approach.hmd_m != 0 && !is_least_range(ownship, placed, approach.time_s))
    return fail("hmd", fmt::format("{} m: at {} s the tracks turn so that their range is greatest there, not least",
                                   short_number_text(approach.hmd_m), short_number_text(approach.time_s)));
  return placed;
}

}  // namespace sigs
