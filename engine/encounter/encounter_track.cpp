// SPDX-License-Identifier: MIT
#include "encounter/encounter_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/text.h"

namespace sigs {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kNever = std::numeric_limits<double>::infinity();

// a * b + c * d, correct to about one unit in the last place where the products cancel (W. Kahan).
double sum_of_products(double a, double b, double c, double d) {
  const double second = c * d;
  const double lost = std::fma(c, d, -second);
  return std::fma(a, b, second) + lost;
}

double bearing_of(const AircraftState& own, const RelativeState& state) {
  const glm::dvec2 s = state.horizontal_m;
  if (s.x == 0 && s.y == 0) return 0;
  const glm::dvec2 course(own.velocity_mps);
  if (std::hypot(course.x, course.y) < kHover_mps) return std::atan2(s.y, s.x);
  // The angle from the course to s, without the difference of two angles, which would have to be brought into range.
  return std::atan2(sum_of_products(course.x, s.y, -course.y, s.x), sum_of_products(course.x, s.x, course.y, s.y));
}

}  // namespace

RelativeState relative_state(const AircraftState& own, const AircraftState& intruder) {
  const glm::dvec3 s = intruder.position_m - own.position_m;
  const glm::dvec3 v = intruder.velocity_mps - own.velocity_mps;
  // 0 - z: no minus before a zero.
  return {{s.x, s.y}, {v.x, v.y}, 0 - s.z, 0 - v.z};
}

bool is_finite(const RelativeState& state) {
  return std::isfinite(state.horizontal_m.x) && std::isfinite(state.horizontal_m.y) &&
         std::isfinite(state.horizontal_mps.x) && std::isfinite(state.horizontal_mps.y) &&
         std::isfinite(state.vertical_m) && std::isfinite(state.vertical_mps);
}

HorizontalLine horizontal_line(const RelativeState& state) {
  const glm::dvec2 s = state.horizontal_m;
  const glm::dvec2 v = state.horizontal_mps;
  HorizontalLine line;
  line.speed_mps = std::hypot(v.x, v.y);
  line.distance_m = std::hypot(s.x, s.y);
  line.across_m = line.distance_m;
  // Below the least normal number a direction has no digits.
  if (line.speed_mps < std::numeric_limits<double>::min()) {
    line.speed_mps = 0;
    return line;
  }
  const double n = line.speed_mps;
  line.along_m = sum_of_products(s.x, v.x / n, s.y, v.y / n);
  line.across_m = std::abs(sum_of_products(s.x, v.y / n, -s.y, v.x / n));
  return line;
}

double tau_mod_s(const RelativeState& state, double dmod_m) {
  if (!is_finite(state)) return kNone;
  const HorizontalLine line = horizontal_line(state);
  if (line.distance_m <= dmod_m) return 0;
  if (!(line.along_m < 0)) return kNever;
  return (line.distance_m - dmod_m) * (line.distance_m + dmod_m) / -line.along_m / line.speed_mps;
}

double time_to_coaltitude_s(const RelativeState& state) {
  if (!is_finite(state)) return kNone;
  if (state.vertical_m == 0) return 0;
  const bool is_nearing = state.vertical_mps != 0 && (state.vertical_m > 0) != (state.vertical_mps > 0);
  return is_nearing ? -state.vertical_m / state.vertical_mps : kNever;
}

RelativeQuantities relative_quantities(const AircraftState& own, const AircraftState& intruder) {
  const RelativeState state = relative_state(own, intruder);
  if (!is_finite(state)) return {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  const HorizontalLine line = horizontal_line(state);
  RelativeQuantities all;
  all.horizontal_range_m = line.distance_m;
  all.vertical_m = state.vertical_m;
  all.range_m = std::hypot(line.distance_m, state.vertical_m);
  all.horizontal_speed_mps = line.speed_mps;
  all.range_rate_mps = all.range_m > 0 ? line.along_m / all.range_m * line.speed_mps +
                                             state.vertical_m / all.range_m * state.vertical_mps
                                       : std::hypot(line.speed_mps, state.vertical_mps);
  all.closing_speed_mps = 0 - all.range_rate_mps;
  all.bearing_rad = bearing_of(own, state);
  all.elevation_rad = all.range_m > 0 ? std::atan2(state.vertical_m, line.distance_m) : 0;
  const double wait_s = line.along_m < 0 ? -line.along_m / line.speed_mps : 0;
  // A speed so low that the time overflows is none.
  const bool is_nearing = line.along_m < 0 && std::isfinite(wait_s);
  all.time_to_closest_s = is_nearing ? wait_s : 0;
  all.hmd_m = is_nearing ? line.across_m : line.distance_m;
  all.vmd_m = state.vertical_m + all.time_to_closest_s * state.vertical_mps;
  all.time_to_coaltitude_s = sigs::time_to_coaltitude_s(state);
  return all;
}

namespace {

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Positions against that of the first of the two, so that nothing is lost far from the origin.
AircraftState on_cubic(const TrackSample& a, const TrackSample& b, double time_s) {
  const double h = b.time_s - a.time_s;
  const double x = (time_s - a.time_s) / h;
  const glm::dvec3 way = b.state.position_m - a.state.position_m;
  const glm::dvec3 va = h * a.state.velocity_mps;
  const glm::dvec3 vb = h * b.state.velocity_mps;
  const glm::dvec3 c2 = 3.0 * way - 2.0 * va - vb;
  const glm::dvec3 c3 = va + vb - 2.0 * way;
  return {a.state.position_m + x * (va + x * (c2 + x * c3)), (va + x * (2.0 * c2 + 3.0 * x * c3)) / h};
}

AircraftState on_line(const TrackSample& a, const TrackSample& b, double time_s) {
  const glm::dvec3 velocity = (b.state.position_m - a.state.position_m) / (b.time_s - a.time_s);
  return {a.state.position_m + (time_s - a.time_s) * velocity, velocity};
}

AircraftState state_at(const SampledTrack& track, double time_s) {
  const std::vector<TrackSample>& samples = track.samples;
  if (samples.size() == 1)
    return {samples[0].state.position_m, track.has_velocities ? samples[0].state.velocity_mps : glm::dvec3(0)};
  const auto after = std::upper_bound(samples.begin(), samples.end(), time_s,
                                      [](double t, const TrackSample& sample) { return t < sample.time_s; });
  const auto next = std::clamp(after - samples.begin(), std::ptrdiff_t{1}, std::ssize(samples) - 1);
  const TrackSample& a = samples[static_cast<std::size_t>(next) - 1];
  const TrackSample& b = samples[static_cast<std::size_t>(next)];
  if (!track.has_velocities) return on_line(a, b, time_s);
  // As recorded, to the last bit.
  if (time_s == a.time_s) return a.state;
  if (time_s == b.time_s) return b.state;
  return on_cubic(a, b, time_s);
}

}  // namespace

Result<void> check_track(const SampledTrack& track) {
  if (track.samples.empty()) return fail(track.name, "has no samples");
  for (std::size_t i = 0; i < track.samples.size(); ++i) {
    const TrackSample& sample = track.samples[i];
    const std::string where = fmt::format("{}: sample {}", track.name, i);
    if (!std::isfinite(sample.time_s) || !is_finite(sample.state.position_m) ||
        (track.has_velocities && !is_finite(sample.state.velocity_mps)))
      return fail(where, "has a number that is not finite");
    if (i > 0 && !(sample.time_s > track.samples[i - 1].time_s))
      return fail(where, fmt::format("its time {} s is not after {} s, that of the sample before it",
                                     exact_text(sample.time_s), exact_text(track.samples[i - 1].time_s)));
  }
  return {};
}

EncounterTrack track_of(SampledTrack track) {
  EncounterTrack made{
      .name = track.name, .first_s = track.samples.front().time_s, .last_s = track.samples.back().time_s};
  for (const TrackSample& sample : track.samples) made.knots_s.push_back(sample.time_s);
  // Shared, so that copies of the track are cheap; it never changes.
  const auto shared = std::make_shared<const SampledTrack>(std::move(track));
  made.at = [shared](double time_s) { return state_at(*shared, time_s); };
  return made;
}

}  // namespace sigs
