// SPDX-License-Identifier: MIT
#include "encounter/brute_force.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include "encounter/encounter.h"

namespace sigs::test {

namespace {

constexpr double kSpan_s = 20;
constexpr double kStep_s = 2e-3;
constexpr double kSame_s = 5e-4;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967295.0;
  }
  int below(int count) { return static_cast<int>(generator_() % static_cast<unsigned>(count)); }

 private:
  std::mt19937 generator_;
};

enum class Kind { straight, circling, places, states };

// A flight with an arithmetic of its own.
struct Flight {
  Kind kind = Kind::straight;
  glm::dvec3 start_m{0, 0, 0};  // of a circle: its centre
  glm::dvec3 velocity_mps{0, 0, 0};
  double radius_m = 0;
  double rate_radps = 0;
  double phase_rad = 0;
  std::vector<TrackSample> samples = {};

  [[nodiscard]] AircraftState at(double t) const {
    if (kind == Kind::straight) return {start_m + t * velocity_mps, velocity_mps};
    if (kind == Kind::circling) {
      const double a = phase_rad + rate_radps * t;
      const glm::dvec3 out(std::cos(a), std::sin(a), 0);
      const glm::dvec3 on(-std::sin(a), std::cos(a), 0);
      return {start_m + radius_m * out + glm::dvec3(0, 0, velocity_mps.z * t),
              radius_m * rate_radps * on + glm::dvec3(0, 0, velocity_mps.z)};
    }
    std::size_t i = 0;
    while (i + 2 < samples.size() && t >= samples[i + 1].time_s) ++i;
    const TrackSample& a = samples[i];
    const TrackSample& b = samples[i + 1];
    const double h = b.time_s - a.time_s;
    const double x = (t - a.time_s) / h;
    const glm::dvec3 p0 = a.state.position_m;
    const glm::dvec3 p3 = b.state.position_m;
    if (kind == Kind::places) return {(1 - x) * p0 + x * p3, (p3 - p0) / h};
    // Bezier's form of the same cubic.
    const glm::dvec3 p1 = p0 + h / 3 * a.state.velocity_mps;
    const glm::dvec3 p2 = p3 - h / 3 * b.state.velocity_mps;
    const double y = 1 - x;
    return {y * y * y * p0 + 3 * x * y * y * p1 + 3 * x * x * y * p2 + x * x * x * p3,
            3 / h * (y * y * (p1 - p0) + 2 * x * y * (p2 - p1) + x * x * (p3 - p2))};
  }
};

Flight random_flight(Random& random, const glm::dvec3& centre_m) {
  Flight flight{.kind = static_cast<Kind>(random.below(4))};
  const double course = random.between(-3.2, 3.2);
  const double speed_mps = random.below(10) == 0 ? 0 : random.between(2, 120);
  flight.velocity_mps = {speed_mps * std::cos(course), speed_mps * std::sin(course), random.between(-8, 8)};
  flight.start_m = centre_m - kSpan_s / 2 * flight.velocity_mps +
                   glm::dvec3(random.between(-150, 150), random.between(-150, 150), random.between(-60, 60));
  if (flight.kind == Kind::circling) {
    flight.start_m = centre_m;
    flight.radius_m = random.between(50, 600);
    flight.rate_radps = (random.below(2) == 0 ? 1 : -1) * random.between(0.05, 0.5);
    flight.phase_rad = random.between(0, 6.3);
  }
  if (flight.kind == Kind::places || flight.kind == Kind::states) {
    const Flight line{.start_m = flight.start_m, .velocity_mps = flight.velocity_mps};
    for (double t = 0; t < kSpan_s + 3; t += random.between(0.3, 3)) {
      AircraftState state = line.at(t);
      state.position_m += glm::dvec3(random.between(-15, 15), random.between(-15, 15), random.between(-5, 5));
      state.velocity_mps += glm::dvec3(random.between(-10, 10), random.between(-10, 10), random.between(-3, 3));
      flight.samples.push_back({t, state});
    }
  }
  return flight;
}

EncounterTrack track_for(const Flight& flight, const std::string& name) {
  if (!flight.samples.empty()) {
    EncounterTrack track =
        track_of({.name = name, .samples = flight.samples, .has_velocities = flight.kind == Kind::states});
    track.last_s = std::min(track.last_s, kSpan_s);
    return track;
  }
  return {.name = name, .first_s = 0, .last_s = kSpan_s, .at = [flight](double t) { return flight.at(t); }};
}

WellClearVolume random_volume(Random& random) {
  WellClearVolume volume{.name = "random", .dmod_m = random.between(5, 400)};
  volume.hmd_m = random.below(3) == 0 ? random.between(5, 400) : volume.dmod_m;
  volume.tau_mod_s = random.below(3) == 0 ? 0 : random.between(0, 15);
  volume.zthr_m = random.between(5, 90);
  volume.tcoa_s = random.below(2) == 0 ? 0 : random.between(0, 10);
  return volume;
}

// The conditions of the standard as they are worded, with squares.
bool is_lost_as_worded(const AircraftState& own, const AircraftState& intruder, const WellClearVolume& volume) {
  const glm::dvec3 s = intruder.position_m - own.position_m;
  const glm::dvec3 v = intruder.velocity_mps - own.velocity_mps;
  const bool is_coaltitude_soon = s.z * v.z < 0 && -s.z / v.z <= volume.tcoa_s;
  if (std::abs(s.z) > volume.zthr_m && !is_coaltitude_soon) return false;
  const double s2 = s.x * s.x + s.y * s.y;
  const double d2 = volume.dmod_m * volume.dmod_m;
  if (s2 <= d2) return true;
  const double sv = s.x * v.x + s.y * v.y;
  if (sv >= 0 || (d2 - s2) / sv > volume.tau_mod_s) return false;
  const double t = -sv / (v.x * v.x + v.y * v.y);
  return std::hypot(s.x + t * v.x, s.y + t * v.y) <= volume.hmd_m;
}

struct Comparison {
  const Flight& own;
  const Flight& intruder;
  const VolumeOutcome& outcome;
  std::vector<double> ends_s = {};

  [[nodiscard]] bool is_lost(double t) const { return is_lost_as_worded(own.at(t), intruder.at(t), outcome.volume); }

  // The first time at which both disagree; negative: none.
  [[nodiscard]] double disagreement(double last_s, long long& instants) const {
    std::size_t next = 0;
    for (double t = kStep_s / 3; t < last_s; t += kStep_s) {
      while (next < ends_s.size() && ends_s[next] < t) ++next;
      ++instants;
      const bool is_near_end =
          (next < ends_s.size() && ends_s[next] - t < kSame_s) || (next > 0 && t - ends_s[next - 1] < kSame_s);
      if (!is_near_end && is_lost(t) != (next % 2 == 1)) return t;
    }
    for (std::size_t i = 0; i < ends_s.size(); ++i) {
      const double before_s = ends_s[i] - kSame_s;
      const double after_s = ends_s[i] + kSame_s;
      // The span's ends, and ends of others, are none to be crossed.
      if (before_s > 0 && (i == 0 || ends_s[i - 1] < before_s) && is_lost(before_s) != (i % 2 == 1)) return before_s;
      if (after_s < last_s && (i + 1 == ends_s.size() || ends_s[i + 1] > after_s) && is_lost(after_s) != (i % 2 == 0))
        return after_s;
    }
    return -1;
  }
};

}  // namespace

BruteForce brute_force(int pairs) {
  BruteForce all;
  Random random(20261122);
  for (; all.pairs < pairs && all.disagreement.empty(); ++all.pairs) {
    const glm::dvec3 centre_m(random.between(-1e5, 1e5), random.between(-1e5, 1e5), random.between(-9000, 0));
    const Flight own = random_flight(random, centre_m);
    const Flight intruder = random_flight(random, centre_m);
    const WellClearVolume volume = random_volume(random);
    const auto begin = std::chrono::steady_clock::now();
    const Result<EncounterSummary> summary =
        encounter_of(track_for(own, "own"), track_for(intruder, "intruder"), {.volumes = {volume}});
    all.search_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!summary) {
      all.disagreement = summary.error().text();
      break;
    }
    Comparison comparison{own, intruder, summary->volumes[0]};
    for (const TimeInterval& loss : summary->volumes[0].losses) {
      ++all.losses;
      all.brief_losses += loss.end_s - loss.begin_s < 0.02 ? 1 : 0;
      comparison.ends_s.push_back(loss.begin_s);
      comparison.ends_s.push_back(loss.end_s);
      if (!comparison.is_lost((loss.begin_s + loss.end_s) / 2)) all.disagreement = "the middle of a loss is none";
    }
    if (const double t = comparison.disagreement(summary->last_s, all.instants); t >= 0)
      all.disagreement = "pair " + std::to_string(all.pairs) + " at " + std::to_string(t) + " s";
  }
  return all;
}

std::string grazes(int pairs) {
  Random random(5);
  for (int pair = 0; pair < pairs; ++pair) {
    const Flight own = random_flight(random, {0, 0, -500});
    const Flight intruder = random_flight(random, {0, 0, -500});
    const EncounterTrack tracks[] = {track_for(own, "own"), track_for(intruder, "intruder")};
    const auto outcome = [&](double radius_m) {
      return encounter_of(tracks[0], tracks[1], {.volumes = {{"cylinder", radius_m, radius_m, 0, 1e5, 0}}}).value();
    };
    const NearestMoment nearest = outcome(100).nearest_horizontal;
    if (nearest.horizontal_m < 1) continue;
    for (const double share : {1e-3, 1e-5}) {
      const std::string where = "pair " + std::to_string(pair) + ", " + std::to_string(nearest.horizontal_m) + " m";
      if (!outcome(nearest.horizontal_m * (1 - share)).volumes[0].losses.empty())
        return where + ": loss in the narrower";
      const double radius_m = nearest.horizontal_m * (1 + share);
      const EncounterSummary wider = outcome(radius_m);
      bool is_there = false;
      for (const TimeInterval& loss : wider.volumes[0].losses) {
        is_there = is_there || (loss.begin_s <= nearest.time_s && nearest.time_s <= loss.end_s);
        for (const double end_s : {loss.begin_s, loss.end_s}) {
          const glm::dvec3 s = intruder.at(end_s).position_m - own.at(end_s).position_m;
          const bool is_cut = end_s == wider.first_s || end_s == wider.last_s;
          if (!is_cut && std::abs(std::hypot(s.x, s.y) - radius_m) > 1e-6)
            return where + ": an end is not on the radius";
        }
      }
      if (!is_there) return where + ": no loss in the wider";
    }
  }
  return {};
}

}  // namespace sigs::test
