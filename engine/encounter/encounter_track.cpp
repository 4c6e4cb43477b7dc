// SPDX-License-Identifier: MIT
#include "encounter/encounter_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/text.h"

namespace sigs {

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
