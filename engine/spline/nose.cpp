// SPDX-License-Identifier: MIT
#include "spline/nose.h"

#include <algorithm>
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

Nose::Nose(const Course& course, const Probes& probes) {
  const double begin_s = probes.all.front().time_s;
  const double end_s = probes.all.back().time_s;
  const std::vector<Gap> gaps = gaps_in(probes);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double from_s = gaps[i].from->time_s;
    const double to_s = gaps[i].to->time_s;
    const bool first = i == 0;
    const bool last = i + 1 == gaps.size();
    const double earliest_s = first ? begin_s : std::midpoint(gaps[i - 1].to->time_s, from_s);
    const double latest_s = last ? end_s : std::midpoint(to_s, gaps[i + 1].from->time_s);
    const bool at_an_end = gaps[i].from->stands() || gaps[i].to->stands();
    turns_.push_back(at_an_end ? held(gaps[i]) : turn_over(gaps[i], earliest_s, latest_s, course));
  }
}

std::vector<Nose::Gap> Nose::gaps_in(const Probes& probes) {
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i + 1 < probes.all.size(); ++i) {
    if (!probes.unclear_after(i)) continue;
    const bool goes_on = !gaps.empty() && gaps.back().to == &probes.all[i];
    if (!goes_on) gaps.push_back({&probes.all[i], nullptr});
    gaps.back().to = &probes.all[i + 1];
  }
  return gaps;
}

// A gap that begins or ends standing still lies at the beginning or the end of the whole course.
Nose::Turn Nose::held(const Gap& gap) {
  const glm::dvec3 known = gap.from->stands() ? gap.to->nose : gap.from->nose;
  const glm::dvec3 nose = known == glm::dvec3(0) ? kForward : known;
  return {gap.from->time_s, gap.to->time_s, nose, nose, nose};
}

Nose::Turn Nose::turn_over(const Gap& gap, double earliest_s, double latest_s, const Course& course) {
  const double about_turns = angle_between(gap.from->nose, gap.to->nose) / std::numbers::pi;
  const double middle_s = std::midpoint(gap.from->time_s, gap.to->time_s);
  const double half_s = about_turns * kAboutTurn_s / 2;
  const double from_s = std::max(std::min(gap.from->time_s, middle_s - half_s), earliest_s);
  const double to_s = std::min(std::max(gap.to->time_s, middle_s + half_s), latest_s);
  const glm::dvec3 from_nose = direction_of(motion_at(course, from_s).velocity_mps);
  const glm::dvec3 to_nose = direction_of(motion_at(course, to_s).velocity_mps);
  return {from_s, to_s, from_nose, half_way(from_nose, to_nose), to_nose};
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

std::vector<double> Nose::sample_times_s(const Probes& probes) const {
  std::vector<double> times_s;
  for (const Probe& probe : probes.all)
    if (!turning_at(probe.time_s)) times_s.push_back(probe.time_s);
  for (const Turn& turn : turns_)
    for (int i = 0; i <= kSamplesPerTurn; ++i)
      times_s.push_back(turn.from_s + (turn.to_s - turn.from_s) * i / kSamplesPerTurn);
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  return times_s;
}

}  // namespace sigs
