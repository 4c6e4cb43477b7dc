// SPDX-License-Identifier: MIT
#include "spline/path_samples.h"

#include <algorithm>
#include <utility>

#include "base/angles.h"
#include "spline/directions.h"
#include "spline/gravity.h"

namespace sigs {

namespace {

// A curve stands below walking pace by far, or where rounding begins to decide its direction.
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
constexpr double kMaxPartsPerPiece = 32;
constexpr double kMinPartsPerPiece = 4;
constexpr double kMaxParts = 2e5;               // of the whole curve, as far as the fewest per piece allow
constexpr std::size_t kMaxSamplesPerPart = 16;  // wild flights take 4; beyond, rounding is looked at ever closer

std::vector<double> spread(std::vector<double> times_s) {
  std::vector<double> kept_s;
  for (const double time_s : times_s)
    if (kept_s.empty() || time_s - kept_s.back() >= kSmallestGap_s) kept_s.push_back(time_s);
  return kept_s;
}

std::vector<double> coarse_times_s(const TimedCurve& timed_curve) {
  const auto pieces = static_cast<double>(std::max<std::size_t>(piece_count(timed_curve), 1));
  const double parts = std::clamp(kMaxParts / pieces, kMinPartsPerPiece, kMaxPartsPerPiece);
  const std::vector<double> inner_s = sample_times_s(timed_curve, static_cast<int>(parts));
  std::vector<double> times_s;
  for (int i = kRunOutSteps; i > 0; --i) times_s.push_back(inner_s.front() - kRunOut_s * i / kRunOutSteps);
  times_s.insert(times_s.end(), inner_s.begin(), inner_s.end());
  for (int i = 1; i <= kRunOutSteps; ++i) times_s.push_back(inner_s.back() + kRunOut_s * i / kRunOutSteps);
  return spread(std::move(times_s));
}

class PathSampler {
 public:
  explicit PathSampler(const TimedCurve& timed_curve) : timed_curve_(timed_curve) {
    const double thousands =
        static_cast<double>(piece_count(timed_curve)) / 1000;  // long courses are looked at less closely
    path_samples_.tolerance_rad = kTolerance_rad * std::clamp(thousands, 1.0, 4.0);
  }

  [[nodiscard]] PathSamples run() && {
    const std::vector<double> times_s = coarse_times_s(timed_curve_);
    double fastest_mps = 0;
    for (const double time_s : times_s)
      fastest_mps = std::max(fastest_mps, length(motion_at(timed_curve_, time_s).velocity_mps));
    max_ = kMaxSamplesPerPart * times_s.size();
    standing_mps_ = std::max(kStanding_mps, kStandingShare * fastest_mps);
    path_samples_.all.push_back(sample_at(times_s.front()));
    for (std::size_t i = 1; i < times_s.size(); ++i) append(sample_at(times_s[i]));
    return std::move(path_samples_);
  }

 private:
  [[nodiscard]] PathSample sample_at(double time_s) const {
    PathSample path_sample{.time_s = time_s, .motion = motion_at(timed_curve_, time_s)};
    const double speed_mps = length(path_sample.motion.velocity_mps);
    if (speed_mps > standing_mps_) path_sample.nose = path_sample.motion.velocity_mps / speed_mps;
    return path_sample;
  }

  // With as many samples before it as it takes.
  void append(const PathSample& next) {
    const PathSample& last = path_samples_.all.back();
    if (too_coarse(last, next)) {
      append(sample_at(last.time_s + (next.time_s - last.time_s) / 2));
      append(next);
    } else {
      path_samples_.all.push_back(next);
    }
  }

  [[nodiscard]] bool too_coarse(const PathSample& a, const PathSample& b) const {
    const double gap_s = b.time_s - a.time_s;
    if (path_samples_.all.size() > max_ || gap_s < 2 * kFinest_s || (a.stands() && b.stands())) return false;
    if (a.stands() != b.stands() || angle_between(a.nose, b.nose) > path_samples_.tolerance_rad) return true;
    const glm::dvec3 force_a = specific_force_mps2(a.motion);
    const glm::dvec3 force_b = specific_force_mps2(b.motion);
    return gap_s > 2 * kFinestForForce_s && angle_between(force_a, force_b) > path_samples_.tolerance_rad;
  }

  const TimedCurve& timed_curve_;
  double standing_mps_ = 0;
  std::size_t max_ = 0;
  PathSamples path_samples_;
};

}  // namespace

bool PathSamples::unclear_after(std::size_t i) const {
  return all[i].stands() || all[i + 1].stands() || angle_between(all[i].nose, all[i + 1].nose) > tolerance_rad;
}

PathSamples sampled_path(const TimedCurve& timed_curve) {
  return PathSampler(timed_curve).run();
}

}  // namespace sigs
