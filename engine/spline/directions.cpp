// SPDX-License-Identifier: MIT
#include "spline/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "spline/constant_speed.h"

namespace sigs {
namespace {

// A curve counts as standing still far below walking pace, and where rounding would decide its direction.
constexpr double kStanding_mps = 0.02;
constexpr double kStandingShare = 1e-6;  // of the greatest speed

// Outside the waypoints the flight is straight; this is long enough for the roll to settle there.
constexpr double kRunOut_s = 2.0;
constexpr int kRunOutSteps = 40;

constexpr double kFinest_s = 0.5e-3;         // for the nose: 2 degrees in this time are 11 turns a second, a corner
constexpr double kFinestForForce_s = 10e-3;  // well below the time in which the roll follows
constexpr double kSmallestGap_s = 1e-7;      // nearer moments are one

constexpr double kTolerance_rad = rad_of_deg(2.0);

// Number of equal parts of a piece that are sampled first, before refinement; fewer where there are very many pieces.
constexpr double kMaxPartsPerPiece = 32;
constexpr double kMinPartsPerPiece = 4;
constexpr double kMaxParts = 2e5;               // of the whole curve, as far as the fewest per piece allow
constexpr std::size_t kMaxSamplesPerPart = 16;  // strongly curved flights need 4; more would only resolve rounding

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
        static_cast<double>(piece_count(timed_curve)) / 1000;  // long flights are sampled less closely
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

  // Inserts as many samples before `next` as are needed.
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

constexpr glm::dvec3 kForward{1, 0, 0};
constexpr double kAboutTurn_s = 0.2;
constexpr double kNearlyOpposite_rad = std::numbers::pi - 0.02;  // nearer, rounding would choose the great circle
constexpr int kSamplesPerTurn = 64;

glm::dvec3 direction_of(const glm::dvec3& velocity_mps) {
  const double speed_mps = length(velocity_mps);
  return speed_mps > 0 ? velocity_mps / speed_mps : kForward;
}

// Straight up or down: the right of an aircraft that pitched up or down from world X.
glm::dvec3 right_of(const glm::dvec3& nose) {
  const glm::dvec3 right = cross(-kWorldUp, nose);
  return length(right) > 1e-6 ? normalize(right) : glm::dvec3(0, 1, 0);
}

glm::dvec3 half_way(const glm::dvec3& from, const glm::dvec3& to) {
  return angle_between(from, to) > kNearlyOpposite_rad ? right_of(from) : along_arc(from, to, 0.5);
}

}  // namespace

double signed_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& axis) {
  return std::atan2(dot(axis, cross(a, b)), dot(a, b));
}

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad) {
  return std::cos(angle_rad) * v + std::sin(angle_rad) * cross(axis, v);
}

glm::dvec3 along_arc(const glm::dvec3& from, const glm::dvec3& to, double share) {
  const double angle_rad = angle_between(from, to);
  const double sine = std::sin(angle_rad);
  if (sine < 1e-9) return normalize((1 - share) * from + share * to);  // the chord is the arc
  return normalize((std::sin((1 - share) * angle_rad) * from + std::sin(share * angle_rad) * to) / sine);
}

glm::dvec3 transported(const glm::dvec3& up, const glm::dvec3& from_nose, const glm::dvec3& to_nose) {
  // The rotation about cross(from, to), written without the axis; it has no meaning for a nose turned right about.
  const double one_plus_cosine = std::max(1 + dot(from_nose, to_nose), 1e-12);
  const glm::dvec3 moved = up - dot(up, to_nose) / one_plus_cosine * (from_nose + to_nose);
  return normalize(across(moved, to_nose));
}

bool PathSamples::unclear_after(std::size_t i) const {
  return all[i].stands() || all[i + 1].stands() || angle_between(all[i].nose, all[i + 1].nose) > tolerance_rad;
}

PathSamples sampled_path(const TimedCurve& timed_curve) {
  return PathSampler(timed_curve).run();
}

glm::dvec3 Nose::Turn::nose_at(double time_s) const {
  const double share = std::clamp((time_s - from_s) / (to_s - from_s), 0.0, 1.0);
  const double eased = share * share * (3 - 2 * share);
  return eased < 0.5 ? along_arc(from_nose, by_nose, 2 * eased) : along_arc(by_nose, to_nose, 2 * eased - 1);
}

Nose::Nose(const TimedCurve& timed_curve, const PathSamples& path_samples) {
  for (const Span& span : unclear_spans(path_samples)) turns_.push_back(turn_over(span, timed_curve, path_samples));
}

// The intervals in which the velocity does not give the nose, widened to the time that their turns take, merged where
// they overlap.
std::vector<Nose::Span> Nose::unclear_spans(const PathSamples& path_samples) {
  const std::vector<PathSample>& all = path_samples.all;
  std::vector<Span> spans;
  for (std::size_t first = 0, past = 0; first + 1 < all.size(); first = past + 1) {
    past = first;
    while (past + 1 < all.size() && path_samples.unclear_after(past)) ++past;
    if (past == first) continue;
    const double half_s = angle_between(all[first].nose, all[past].nose) / std::numbers::pi * kAboutTurn_s / 2;
    const double middle_s = std::midpoint(all[first].time_s, all[past].time_s);
    const Span span{std::max(std::min(all[first].time_s, middle_s - half_s), all.front().time_s),
                    std::min(std::max(all[past].time_s, middle_s + half_s), all.back().time_s)};
    if (!spans.empty() && span.from_s <= spans.back().to_s)
      spans.back().to_s = std::max(spans.back().to_s, span.to_s);
    else
      spans.push_back(span);
  }
  return spans;
}

Nose::Turn Nose::turn_over(const Span& span, const TimedCurve& timed_curve, const PathSamples& path_samples) {
  const bool stands_before = span.from_s == path_samples.all.front().time_s && path_samples.all.front().stands();
  const bool stands_after = span.to_s == path_samples.all.back().time_s && path_samples.all.back().stands();
  glm::dvec3 from = direction_of(motion_at(timed_curve, span.from_s).velocity_mps);
  glm::dvec3 to = direction_of(motion_at(timed_curve, span.to_s).velocity_mps);
  if (stands_before && stands_after) from = to = kForward;
  if (stands_before) from = to;
  if (stands_after) to = from;
  return {span.from_s, span.to_s, from, half_way(from, to), to};
}

const Nose::Turn* Nose::turn_at(double time_s) const {
  const auto next = std::upper_bound(turns_.begin(), turns_.end(), time_s,
                                     [](double value, const Turn& turn) { return value < turn.from_s; });
  if (next == turns_.begin()) return nullptr;
  const Turn& turn = *std::prev(next);
  return time_s <= turn.to_s ? &turn : nullptr;
}

glm::dvec3 Nose::at(double time_s, const glm::dvec3& velocity_mps) const {
  const Turn* turn = turn_at(time_s);
  return turn ? turn->nose_at(time_s) : direction_of(velocity_mps);
}

std::vector<double> Nose::sample_times_s(const PathSamples& path_samples) const {
  std::vector<double> times_s;
  for (const PathSample& path_sample : path_samples.all)
    if (!turning_at(path_sample.time_s)) times_s.push_back(path_sample.time_s);
  for (const Turn& turn : turns_)
    for (int i = 0; i <= kSamplesPerTurn; ++i)
      times_s.push_back(std::lerp(turn.from_s, turn.to_s, static_cast<double>(i) / kSamplesPerTurn));
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  return times_s;
}

}  // namespace sigs
