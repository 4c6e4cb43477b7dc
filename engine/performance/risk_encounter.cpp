// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "encounter_model/model_flight.h"
#include "performance/risk.h"

namespace sigs {

namespace {

constexpr double kLongestStep_s = 0.1;

double between(const std::array<double, 2>& limits, Random& random) {
  return limits[0] + (limits[1] - limits[0]) * random.uniform();
}

// An offset to both sides, even within the limit; with importance sampling half of them within the inner limit. The
// weight is the even density by the one that was drawn from.
struct DrawnOffset {
  double offset_m = 0;
  double weight = 1;
};

DrawnOffset drawn_offset(double limit_m, double inner_m, bool importance, Random& random) {
  const double inner = importance ? std::min(inner_m, limit_m) : limit_m;
  const bool is_inner = random.uniform() < 0.5;
  const double reach = is_inner ? inner : limit_m;
  const double offset_m = reach * (2 * random.uniform() - 1);
  if (!(limit_m > 0)) return {0, 1};
  const double density = 0.5 + (std::abs(offset_m) <= inner ? 0.5 * limit_m / inner : 0);
  return {offset_m, 1 / density};
}

// The flight of one aircraft over the whole encounter, beginning at the origin, its first course along north.
ModelFlight drawn_flight_of(const std::optional<EncounterModel>& model, const std::array<double, 2>& speed_mps,
                            int length_s, Random& random) {
  if (model) return drawn_flight(*model, {.duration_s = length_s, .max_redraws = 100}, random);
  SampledPoint point;
  point.speed_mps = between(speed_mps, random);
  return {.points = {point}};
}

// At any time, beyond the flight's end too: straight flights have one point, without turn or acceleration.
SampledPoint point_at(const ModelFlight& flight, double time_s) {
  const auto last = flight.points.size() - 1;
  const auto before = std::min(last, static_cast<std::size_t>(std::max(0.0, time_s)));
  return moved_on(flight.points[before], time_s - flight.points[before].time_s);
}

// Turned to the right about the vertical through a place, and moved.
AircraftState state_of(const SampledPoint& point, const glm::dvec3& centre_neu_m, double turned_rad,
                       const glm::dvec3& to_neu_m) {
  const glm::dvec3 from_m = point.position_neu_m - centre_neu_m;
  const double c = std::cos(turned_rad), s = std::sin(turned_rad);
  const double heading = point.heading_rad + turned_rad;
  return {.position_m = {to_neu_m.x + c * from_m.x - s * from_m.y, to_neu_m.y + s * from_m.x + c * from_m.y,
                         -(to_neu_m.z + from_m.z)},
          .velocity_mps = {point.speed_mps * std::cos(heading), point.speed_mps * std::sin(heading),
                           -point.vertical_speed_mps}};
}

// At all steps. Straight flights, which most are, need no turning at each.
std::vector<AircraftState> states_of(const ModelFlight& flight, const glm::dvec3& centre_neu_m, double turned_rad,
                                     const glm::dvec3& to_neu_m, int length_s, double step_s) {
  const auto count = static_cast<std::size_t>(std::floor(length_s / step_s)) + 1;
  std::vector<AircraftState> states;
  states.reserve(count);
  if (flight.points.size() == 1) {
    const AircraftState first = state_of(flight.points[0], centre_neu_m, turned_rad, to_neu_m);
    for (std::size_t k = 0; k < count; ++k)
      states.push_back({first.position_m + static_cast<double>(k) * step_s * first.velocity_mps, first.velocity_mps});
    return states;
  }
  for (std::size_t k = 0; k < count; ++k)
    states.push_back(state_of(point_at(flight, static_cast<double>(k) * step_s), centre_neu_m, turned_rad, to_neu_m));
  return states;
}

}  // namespace

FlownPair drawn_pair(const RiskEncounters& encounters, const Steps& steps, Random& random) {
  const int length_s = encounters.lead_s + encounters.after_s;
  const ModelFlight own = drawn_flight_of(encounters.own_model, encounters.own_speed_mps, length_s, random);
  const auto models = encounters.intruder_models.size();
  const std::optional<EncounterModel> none;
  const std::size_t chosen = models > 1 ? random.bits() % models : 0;
  const ModelFlight intruder = models > 0 ? drawn_flight(encounters.intruder_models[chosen],
                                                         {.duration_s = length_s, .max_redraws = 100}, random)
                                          : drawn_flight_of(none, encounters.intruder_speed_mps, length_s, random);
  const SampledPoint own_near = point_at(own, encounters.lead_s);
  const SampledPoint intruder_near = point_at(intruder, encounters.lead_s);
  const double turned_rad = 2 * std::numbers::pi * random.uniform();
  const double course_rad = intruder_near.heading_rad + turned_rad;
  const glm::dvec2 relative_mps =
      intruder_near.speed_mps * glm::dvec2(std::cos(course_rad), std::sin(course_rad)) -
      own_near.speed_mps * glm::dvec2(std::cos(own_near.heading_rad), std::sin(own_near.heading_rad));
  const double speed_mps = glm::length(relative_mps);
  const DrawnOffset miss =
      drawn_offset(encounters.miss_m, 2 * nmac_volume().hmd_m, encounters.importance_sampling, random);
  const DrawnOffset vertical =
      drawn_offset(encounters.vertical_miss_m, 2 * nmac_volume().zthr_m, encounters.importance_sampling, random);
  const glm::dvec2 across =
      speed_mps > 1e-6 ? glm::dvec2(-relative_mps.y, relative_mps.x) / speed_mps : glm::dvec2(0, 1);
  const glm::dvec3 place_m = own_near.position_neu_m + glm::dvec3(miss.offset_m * across, vertical.offset_m);
  FlownPair pair{.step_s = steps.step_s, .weight = speed_mps * miss.weight * vertical.weight};
  pair.own = states_of(own, {0, 0, 0}, 0, {0, 0, 0}, length_s, steps.step_s);
  pair.intruder = states_of(intruder, intruder_near.position_neu_m, turned_rad, place_m, length_s, steps.step_s);
  return pair;
}

FlownPair recorded_pair(const RiskPair& recorded, const Steps& steps) {
  FlownPair pair{.step_s = steps.step_s};
  const double first_s = std::max(recorded.own.first_s, recorded.intruder.first_s);
  const double last_s = std::min(recorded.own.last_s, recorded.intruder.last_s);
  for (int k = 0; first_s + k * steps.step_s <= last_s; ++k) {
    pair.own.push_back(recorded.own.at(first_s + k * steps.step_s));
    pair.intruder.push_back(recorded.intruder.at(first_s + k * steps.step_s));
  }
  return pair;
}

Steps steps_of(double rate_hz) {
  const double frame_s = 1 / rate_hz;
  const int of_frame = std::max(1, static_cast<int>(std::ceil(frame_s / kLongestStep_s - 1e-9)));
  return {frame_s / of_frame, of_frame};
}

Result<void> check_flights(const RiskEncounters& encounters) {
  if (encounters.own_model)
    if (const Result<void> flies = check_can_fly(*encounters.own_model); !flies) return flies;
  for (const EncounterModel& model : encounters.intruder_models)
    if (const Result<void> flies = check_can_fly(model); !flies) return flies;
  for (const auto& limits : {encounters.own_speed_mps, encounters.intruder_speed_mps})
    if (!(limits[0] >= 0 && limits[1] >= limits[0] && std::isfinite(limits[1])))
      return fail("speed", "must be two numbers from 0 on, the lower first", ErrorKind::usage);
  return {};
}

}  // namespace sigs
