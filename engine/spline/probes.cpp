// SPDX-License-Identifier: MIT
#include "spline/probes.h"

#include <algorithm>
#include <utility>

#include "base/angles.h"
#include "spline/directions.h"
#include "spline/gravity.h"

namespace sigs {

namespace {

// A course stands below walking pace by far, or where rounding begins to decide its direction.
constexpr double kStanding_mps = 0.02;
constexpr double kStandingShare = 1e-6;  // of the greatest speed

// Outside the waypoints the flight is straight; this is long enough for the roll to come to rest there.
constexpr double kRunOut_s = 2.0;
constexpr int kRunOutSteps = 40;

constexpr double kFinest_s = 0.5e-3;         // for the nose: 2 degrees in this time are 11 turns a second, a corner
constexpr double kFinestForForce_s = 10e-3;  // well below the time in which the roll follows
constexpr double kSmallestGap_s = 1e-7;      // nearer moments are one

constexpr double kTolerance_rad = rad_of_deg(2.0);

// The first look, before it is refined: so many equal parts of a piece, fewer where there are very many pieces.
constexpr double kMostPartsPerPiece = 32;
constexpr double kFewestPartsPerPiece = 4;
constexpr double kMostParts = 2e5;              // of the whole course, as far as the fewest per piece allow
constexpr std::size_t kMostProbesPerPart = 16;  // wild flights take 4; beyond, rounding is looked at ever closer

std::vector<double> spread(std::vector<double> times_s) {
  std::vector<double> kept_s;
  for (const double time_s : times_s)
    if (kept_s.empty() || time_s - kept_s.back() >= kSmallestGap_s) kept_s.push_back(time_s);
  return kept_s;
}

std::vector<double> coarse_times_s(const Course& course) {
  const auto pieces = static_cast<double>(std::max<std::size_t>(piece_count(course), 1));
  const double parts = std::clamp(kMostParts / pieces, kFewestPartsPerPiece, kMostPartsPerPiece);
  const std::vector<double> inner_s = sample_times_s(course, static_cast<int>(parts));
  std::vector<double> times_s;
  for (int i = kRunOutSteps; i > 0; --i) times_s.push_back(inner_s.front() - kRunOut_s * i / kRunOutSteps);
  times_s.insert(times_s.end(), inner_s.begin(), inner_s.end());
  for (int i = 1; i <= kRunOutSteps; ++i) times_s.push_back(inner_s.back() + kRunOut_s * i / kRunOutSteps);
  return spread(std::move(times_s));
}

class Prober {
 public:
  explicit Prober(const Course& course) : course_(course) {
    const double thousands =
        static_cast<double>(piece_count(course)) / 1000;  // long courses are looked at less closely
    probes_.tolerance_rad = kTolerance_rad * std::clamp(thousands, 1.0, 4.0);
  }

  [[nodiscard]] Probes run() && {
    const std::vector<double> times_s = coarse_times_s(course_);
    double fastest_mps = 0;
    for (const double time_s : times_s)
      fastest_mps = std::max(fastest_mps, length(motion_at(course_, time_s).velocity_mps));
    most_ = kMostProbesPerPart * times_s.size();
    standing_mps_ = std::max(kStanding_mps, kStandingShare * fastest_mps);
    probes_.all.push_back(probe_at(times_s.front()));
    for (std::size_t i = 1; i < times_s.size(); ++i) append(probe_at(times_s[i]));
    return std::move(probes_);
  }

 private:
  [[nodiscard]] Probe probe_at(double time_s) const {
    Probe probe{.time_s = time_s, .motion = motion_at(course_, time_s)};
    const double speed_mps = length(probe.motion.velocity_mps);
    if (speed_mps > standing_mps_) probe.nose = probe.motion.velocity_mps / speed_mps;
    return probe;
  }

  // With as many probes before it as it takes.
  void append(const Probe& next) {
    const Probe& last = probes_.all.back();
    if (too_coarse(last, next)) {
      append(probe_at(last.time_s + (next.time_s - last.time_s) / 2));
      append(next);
    } else {
      probes_.all.push_back(next);
    }
  }

  [[nodiscard]] bool too_coarse(const Probe& a, const Probe& b) const {
    const double gap_s = b.time_s - a.time_s;
    if (probes_.all.size() > most_ || gap_s < 2 * kFinest_s || (a.stands() && b.stands())) return false;
    if (a.stands() != b.stands() || angle_between(a.nose, b.nose) > probes_.tolerance_rad) return true;
    const glm::dvec3 force_a = specific_force_mps2(a.motion);
    const glm::dvec3 force_b = specific_force_mps2(b.motion);
    return gap_s > 2 * kFinestForForce_s && angle_between(force_a, force_b) > probes_.tolerance_rad;
  }

  const Course& course_;
  double standing_mps_ = 0;
  std::size_t most_ = 0;
  Probes probes_;
};

}  // namespace

bool Probes::unclear_after(std::size_t i) const {
  return all[i].stands() || all[i + 1].stands() || angle_between(all[i].nose, all[i + 1].nose) > tolerance_rad;
}

Probes probes_of(const Course& course) {
  return Prober(course).run();
}

}  // namespace sigs
