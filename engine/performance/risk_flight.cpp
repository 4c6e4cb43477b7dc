// SPDX-License-Identifier: MIT
#include "performance/risk.h"

#include <algorithm>
#include <cmath>

#include "base/pose.h"

namespace sigs {

namespace {

constexpr double kHalfHeight_m = 1.5;  // of an intruder: so much above or below the camera it is on the horizon

// --- Events.

// Whether the two come within a cylinder during a step, on straight flight from one state to the next.
bool enters(const RelativeState& from, const RelativeState& to, double radius_m, double height_m) {
  // Times of vertical closeness, 0..1.
  const double rise = to.vertical_m - from.vertical_m;
  double begin = 0, end = 1;
  if (rise == 0) {
    if (std::abs(from.vertical_m) > height_m) return false;
  } else {
    const double a = (-height_m - from.vertical_m) / rise, b = (height_m - from.vertical_m) / rise;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
    if (begin > end) return false;
  }
  // The least horizontal distance in that time.
  const glm::dvec2 way = to.horizontal_m - from.horizontal_m;
  const double square = glm::dot(way, way);
  const double nearest = square > 0 ? std::clamp(-glm::dot(from.horizontal_m, way) / square, begin, end) : begin;
  const glm::dvec2 at = from.horizontal_m + nearest * way;
  return glm::dot(at, at) <= radius_m * radius_m;
}

// First steps at which each happens; the number of steps where it does not.
struct Events {
  std::size_t nmac = 0;
  std::size_t lost = 0;
};

Events events_of(const FlownPair& pair, const std::vector<AircraftState>& own, std::size_t begin,
                 const WellClearVolume& volume) {
  const std::size_t count = own.size();
  Events events{count, count};
  const WellClearVolume& nmac = nmac_volume();
  const bool is_cylinder = volume.tau_mod_s == 0 && volume.tcoa_s == 0;
  const double radius_m = std::max(volume.dmod_m, nmac.dmod_m);
  for (std::size_t k = begin; k + 1 < count; ++k) {
    const RelativeState from = relative_state(own[k], pair.intruder[k]);
    // Far away nothing happens before they have come nearer.
    const double speed_mps = glm::length(from.horizontal_mps);
    const double distance_m = glm::length(from.horizontal_m);
    if (is_cylinder && distance_m > radius_m + 3 * speed_mps * pair.step_s + 50) continue;
    const RelativeState to = relative_state(own[k + 1], pair.intruder[k + 1]);
    if (events.nmac == count && enters(from, to, nmac.dmod_m, nmac.zthr_m)) events.nmac = k;
    if (events.lost == count &&
        (is_cylinder ? enters(from, to, volume.dmod_m, volume.zthr_m) : has_lost_well_clear(from, volume)))
      events.lost = k;
    if (events.nmac < count && events.lost < count) break;
  }
  return events;
}

// --- The sensor.

// Angles from the own aircraft, to the right of its course and upwards.
glm::dvec2 view_of(const AircraftState& own, const glm::dvec3& offset_m) {
  const double course = std::atan2(own.velocity_mps.y, own.velocity_mps.x);
  return {std::remainder(std::atan2(offset_m.y, offset_m.x) - course, 2 * std::numbers::pi),
          std::atan2(-offset_m.z, std::hypot(offset_m.x, offset_m.y))};
}

struct Decision {
  std::optional<std::size_t> first_in_view;
  std::size_t declared = 0;  // step of it, where is_declared
  bool is_declared = false;
  std::size_t begin = 0;  // step of the manoeuvre's begin; the number of steps: none
  ManoeuvreKind kind = ManoeuvreKind::none;
};

ThreatView threat_of(const SensorModel& sensor, const AircraftState& own, const AircraftState& intruder,
                     std::int64_t number, double time_s, Random& random) {
  const glm::dvec3 offset_m = intruder.position_m - own.position_m;
  const glm::dvec3 speed_mps = intruder.velocity_mps - own.velocity_mps;
  const glm::dvec2 angles = view_of(own, offset_m);
  const double across_square = offset_m.x * offset_m.x + offset_m.y * offset_m.y;
  const double across_m = std::max(std::sqrt(across_square), 1e-6);
  const double bearing_rate = (offset_m.x * speed_mps.y - offset_m.y * speed_mps.x) / std::max(across_square, 1e-12);
  const double across_speed = (offset_m.x * speed_mps.x + offset_m.y * speed_mps.y) / across_m;
  const double elevation_rate =
      (-speed_mps.z * across_m + offset_m.z * across_speed) / std::max(glm::dot(offset_m, offset_m), 1e-12);
  // Rates by the difference of two angles a second apart, or as far as the frames of a declaration where that is more.
  const double apart_s = std::max(1.0, (sensor.declare_window - 1) / sensor.rate_hz);
  const auto error = [&](double sd) { return sd * normal_number(random); };
  ThreatView view{
      .encounter = number,
      .time_s = time_s,
      .bearing_rad = angles.x + sensor.bearing_bias_rad + error(sensor.bearing_sd_rad),
      .elevation_rad = angles.y + sensor.elevation_bias_rad + error(sensor.elevation_sd_rad),
      .bearing_rate_radps = bearing_rate + error(sensor.bearing_sd_rad * std::numbers::sqrt2 / apart_s),
      .elevation_rate_radps = elevation_rate + error(sensor.elevation_sd_rad * std::numbers::sqrt2 / apart_s),
      .range_m = {},
      .own_speed_mps = glm::length(own.velocity_mps)};
  if (sensor.range_sd) view.range_m = glm::length(offset_m) * std::max(0.0, 1 + error(*sensor.range_sd));
  return view;
}

// Which way "away" is.
ManoeuvreKind resolved_kind(ManoeuvreKind kind, const ThreatView& view) {
  constexpr double kNoDrift_radps = 0.0017453292519943;  // 0.1 degree a second
  if (kind == ManoeuvreKind::turn_away)
    return view.bearing_rate_radps > kNoDrift_radps ? ManoeuvreKind::turn_left : ManoeuvreKind::turn_right;
  if (kind == ManoeuvreKind::vertical_away) {
    const bool has_drift = std::abs(view.elevation_rate_radps) > kNoDrift_radps;
    return (has_drift ? view.elevation_rate_radps : view.elevation_rad) >= 0 ? ManoeuvreKind::descend
                                                                             : ManoeuvreKind::climb;
  }
  return kind;
}

Result<ManoeuvreKind> decided(const RiskSettings& settings, const Logic& logic, const ThreatView& view) {
  if (std::hypot(view.bearing_rate_radps, view.elevation_rate_radps) > settings.alert_rate_radps)
    return ManoeuvreKind::none;
  const Result<ManoeuvreKind> kind = logic ? logic(view) : Result<ManoeuvreKind>(settings.manoeuvre.kind);
  return kind ? Result<ManoeuvreKind>(resolved_kind(*kind, view)) : kind;
}

std::size_t step_of_begin(const RiskSettings& settings, const FlownPair& pair, double known_s) {
  const double steps = std::ceil((known_s + settings.manoeuvre.delay_s) / pair.step_s - 1e-9);
  return steps < static_cast<double>(pair.own.size()) ? static_cast<std::size_t>(std::max(0.0, steps))
                                                      : pair.own.size();
}

// What is decided at a step at which a track is declared, known so late; the manoeuvre's begin is set where there is
// one. A track waits while it is too far away, recedes or turns too fast.
Result<void> decide_at(Decision& decision, std::size_t k, double latency_s, const RiskSettings& settings,
                       const FlownPair& pair, std::int64_t number, const Logic& logic, Random& random) {
  if (!decision.is_declared) decision.declared = k;
  decision.is_declared = true;
  const AircraftState& own = pair.own[k];
  const AircraftState& intruder = pair.intruder[k];
  const glm::dvec3 offset_m = intruder.position_m - own.position_m;
  if (glm::length(offset_m) > settings.alert_range_m) return {};
  if (glm::dot(offset_m, intruder.velocity_mps - own.velocity_mps) > 0) return {};
  const double time_s = static_cast<double>(k) * pair.step_s;
  const Result<ManoeuvreKind> kind =
      decided(settings, logic, threat_of(settings.sensor, own, intruder, number, time_s, random));
  if (!kind) return fail(kind.error());
  decision.kind = *kind;
  if (*kind != ManoeuvreKind::none) decision.begin = step_of_begin(settings, pair, time_s + latency_s);
  return {};
}

Result<Decision> seen_by_sensor(const RiskSettings& settings, const FlownPair& pair, const Steps& steps,
                                std::int64_t number, const Logic& logic, Random& random) {
  const SensorModel& sensor = settings.sensor;
  Decision decision{.begin = pair.own.size()};
  SensorDraw draw(sensor, random);
  const double far_m = sensor.range_m.back();
  double last_seen_s = 0;
  bool was_in_reach = false;
  const auto frame_steps = static_cast<std::size_t>(steps.of_frame);
  for (std::size_t k = 0; k < pair.own.size(); k += frame_steps) {
    const AircraftState& own = pair.own[k];
    const glm::dvec3 offset_m = pair.intruder[k].position_m - own.position_m;
    const double range_square = glm::dot(offset_m, offset_m);
    if (range_square > far_m * far_m) {
      if (was_in_reach) (void)draw.is_declared(false);
      continue;
    }
    const double time_s = static_cast<double>(k) * pair.step_s;
    bool is_detected = false;
    if (sensor.field_of_view.holds(view_of(own, offset_m))) {
      if (!decision.first_in_view) decision.first_in_view = k;
      const HorizonSide side = std::abs(offset_m.z) < kHalfHeight_m ? HorizonSide::on
                               : offset_m.z < 0                     ? HorizonSide::above
                                                                    : HorizonSide::below;
      const double aspect = angle_between(pair.intruder[k].velocity_mps, -offset_m);
      const double quantile = sensor.quantile_at(std::sqrt(range_square), side, aspect);
      is_detected = draw.detects(quantile, was_in_reach ? time_s - last_seen_s : 0, random);
      last_seen_s = time_s;
    }
    was_in_reach = true;
    if (!draw.is_declared(is_detected)) continue;
    if (const Result<void> done = decide_at(decision, k, sensor.latency_s, settings, pair, number, logic, random);
        !done)
      return fail(done.error());
    if (decision.kind != ManoeuvreKind::none) return decision;
  }
  return decision;
}

// From the declaration on, which has the latency in it, at each of the sensor's frames.
Result<Decision> seen_in_images(const RiskSettings& settings, const RiskPair& recorded, const FlownPair& pair,
                                const Steps& steps, std::int64_t number, const Logic& logic, Random& random) {
  Decision decision{.first_in_view = 0, .begin = pair.own.size()};  // images tell no more
  if (!recorded.declared_s) return decision;
  const double first_s = std::max(recorded.own.first_s, recorded.intruder.first_s);
  const auto declared = static_cast<std::size_t>(std::max(0.0, *recorded.declared_s - first_s) / pair.step_s);
  for (std::size_t k = std::min(pair.own.size() - 1, declared); k < pair.own.size();
       k += static_cast<std::size_t>(steps.of_frame)) {
    if (const Result<void> done = decide_at(decision, k, 0, settings, pair, number, logic, random); !done)
      return fail(done.error());
    if (decision.kind != ManoeuvreKind::none) break;
  }
  return decision;
}

// --- The manoeuvre.

double towards(double value, double target, double most) {
  return value < target ? std::min(target, value + most) : std::max(target, value - most);
}

// The own flight with the manoeuvre from a step on.
std::vector<AircraftState> manoeuvred(const FlownPair& pair, const Decision& decision, const Manoeuvre& manoeuvre) {
  std::vector<AircraftState> own(pair.own.begin(), pair.own.begin() + static_cast<std::ptrdiff_t>(decision.begin + 1));
  own.reserve(pair.own.size());
  const AircraftState& start = own.back();
  const ManoeuvreKind kind = decision.kind;
  double speed = std::hypot(start.velocity_mps.x, start.velocity_mps.y);
  double course = std::atan2(start.velocity_mps.y, start.velocity_mps.x);
  double rate = start.velocity_mps.z;  // down
  const double side = kind == ManoeuvreKind::turn_right ? 1 : kind == ManoeuvreKind::turn_left ? -1 : 0;
  const double down = kind == ManoeuvreKind::descend ? 1 : kind == ManoeuvreKind::climb ? -1 : 0;
  double turned = 0;
  const double start_z = start.position_m.z;
  for (std::size_t k = decision.begin; k + 1 < pair.own.size(); ++k) {
    const AircraftState before = own.back();
    const double step = pair.step_s;
    const double turn = std::min(manoeuvre.turn_rate_radps * step, manoeuvre.heading_change_rad - turned);
    const double middle = course + side * turn / 2;
    if (side != 0) {
      turned += turn;
      course += side * turn;
    }
    if (kind == ManoeuvreKind::slow_down && speed > manoeuvre.min_speed_mps)
      speed = towards(speed, manoeuvre.min_speed_mps, manoeuvre.acceleration_mps2 * step);
    if (kind == ManoeuvreKind::speed_up && speed < manoeuvre.max_speed_mps)
      speed = towards(speed, manoeuvre.max_speed_mps, manoeuvre.acceleration_mps2 * step);
    const double was = rate;
    if (down != 0) {
      const bool is_done = std::abs(before.position_m.z - start_z) >= manoeuvre.height_change_m;
      rate = towards(rate, is_done ? 0 : down * manoeuvre.climb_mps, manoeuvre.vertical_acceleration_mps2 * step);
    }
    // What cannot wait a step does not: an infinite acceleration acts at once.
    const double mean_rate = std::isinf(manoeuvre.vertical_acceleration_mps2) ? rate : (was + rate) / 2;
    own.push_back({.position_m = before.position_m +
                                 step * glm::dvec3(speed * std::cos(middle), speed * std::sin(middle), mean_rate),
                   .velocity_mps = {speed * std::cos(course), speed * std::sin(course), rate}});
  }
  return own;
}

Geometry geometry_of(const AircraftState& own, const AircraftState& intruder) {
  const glm::dvec3 a(own.velocity_mps.x, own.velocity_mps.y, 0), b(intruder.velocity_mps.x, intruder.velocity_mps.y, 0);
  const double between_rad = angle_between(a, b);
  return between_rad > 3 * std::numbers::pi / 4 ? Geometry::head_on
         : between_rad < std::numbers::pi / 4   ? Geometry::overtaking
                                                : Geometry::crossing;
}

}  // namespace

Result<FlownOutcome> flown_encounter(const RiskSettings& settings, std::int64_t number, const Logic& logic) {
  Random random(settings.seed, static_cast<std::uint64_t>(number));
  const Steps steps = steps_of(settings.sensor.rate_hz);
  const std::vector<RiskPair>& pairs = settings.encounters.pairs;
  const RiskPair* const recorded = pairs.empty() ? nullptr : &pairs[static_cast<std::size_t>(number) % pairs.size()];
  const FlownPair pair = recorded ? recorded_pair(*recorded, steps) : drawn_pair(settings.encounters, steps, random);
  FlownOutcome outcome{.weight = pair.weight};
  if (pair.own.empty()) return outcome;
  const Events without = events_of(pair, pair.own, 0, settings.well_clear);
  const std::size_t none = pair.own.size();
  outcome.nmac_without = without.nmac < none;
  outcome.lost_without = without.lost < none;
  outcome.is_above = pair.intruder.front().position_m.z < pair.own.front().position_m.z;
  const std::size_t near =
      recorded ? none / 2 : std::min(none - 1, static_cast<std::size_t>(settings.encounters.lead_s / pair.step_s));
  outcome.geometry = geometry_of(pair.own[near], pair.intruder[near]);
  const Result<Decision> decision = recorded && recorded->is_from_images
                                        ? seen_in_images(settings, *recorded, pair, steps, number, logic, random)
                                        : seen_by_sensor(settings, pair, steps, number, logic, random);
  if (!decision) return fail(decision.error());
  // What comes after an NMAC is no help.
  outcome.is_in_view = decision->first_in_view && *decision->first_in_view < without.nmac;
  outcome.is_declared = decision->is_declared && decision->declared < without.nmac;
  outcome.is_manoeuvred = decision->begin < none && decision->begin <= without.nmac;
  outcome.nmac_with = outcome.nmac_without;
  outcome.lost_with = outcome.lost_without;
  if (!outcome.is_manoeuvred) return outcome;
  const Events with =
      events_of(pair, manoeuvred(pair, *decision, settings.manoeuvre), decision->begin, settings.well_clear);
  outcome.nmac_with = without.nmac < decision->begin || with.nmac < none;
  outcome.lost_with = without.lost < decision->begin || with.lost < none;
  return outcome;
}

}  // namespace sigs
