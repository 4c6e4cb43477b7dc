// SPDX-License-Identifier: MIT
#include "spline/nose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "spline/directions.h"

namespace sigs {

namespace {

constexpr glm::dvec3 kForward{1, 0, 0};
constexpr double kAboutTurn_s = 0.2;
constexpr double kNearlyOpposite_rad = std::numbers::pi - 0.02;  // nearer, rounding would choose the great circle
constexpr int kSamplesPerTurn = 64;

glm::dvec3 direction_of(const glm::dvec3& velocity_mps) {
  const double speed_mps = length(velocity_mps);
  return speed_mps > 0 ? velocity_mps / speed_mps : kForward;
}

// Straight up or down, right is where it is for an aircraft that pitched up or down from world X.
glm::dvec3 right_of(const glm::dvec3& nose) {
  const glm::dvec3 right = cross(-kWorldUp, nose);
  return length(right) > 1e-6 ? normalize(right) : glm::dvec3(0, 1, 0);
}

glm::dvec3 half_way(const glm::dvec3& from, const glm::dvec3& to) {
  return angle_between(from, to) > kNearlyOpposite_rad ? right_of(from) : along_arc(from, to, 0.5);
}

}  // namespace

glm::dvec3 Nose::Turn::nose_at(double time_s) const {
  const double share = std::clamp((time_s - from_s) / (to_s - from_s), 0.0, 1.0);
  const double eased = share * share * (3 - 2 * share);
  return eased < 0.5 ? along_arc(from_nose, by_nose, 2 * eased) : along_arc(by_nose, to_nose, 2 * eased - 1);
}

Nose::Nose(const TimedCurve& timed_curve, const PathSamples& path_samples) {
  for (const Span& span : unclear_spans(path_samples)) turns_.push_back(turn_over(span, timed_curve, path_samples));
}

// Widened to the time that their turns take, and none over another.
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
