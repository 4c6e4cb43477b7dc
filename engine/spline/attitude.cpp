// SPDX-License-Identifier: MIT
#include "spline/attitude.h"

#include <algorithm>

#include "spline/directions.h"
#include "spline/gravity.h"
#include "spline/roll.h"
#include "spline/up_target.h"

namespace sigs {

namespace {

// In a turn of its own the aircraft goes by no path, so no force tells its bank: it is taken as level.
std::vector<FlightSample> samples_of(const TimedCurve& timed_curve, const Nose& nose,
                                     const std::vector<double>& times_s) {
  std::vector<FlightSample> samples;
  samples.reserve(times_s.size());
  for (const double time_s : times_s) {
    const Motion motion = motion_at(timed_curve, time_s);
    samples.push_back({.time_s = time_s,
                       .nose = nose.at(time_s, motion.velocity_mps),
                       .specific_force_mps2 = specific_force_mps2(nose.turning_at(time_s) ? Motion{} : motion)});
  }
  return samples;
}

// Level where there is a level; straight up or down, as if pitched there from world X.
glm::dvec3 first_up(const glm::dvec3& nose) {
  const glm::dvec3 level = level_up(nose);
  return normalize(length(level) > 1e-6 ? level : across(glm::dvec3(nose.z, 0, 0), nose));
}

std::vector<glm::dvec3> transported_ups(const std::vector<FlightSample>& samples) {
  std::vector<glm::dvec3> ups{first_up(samples.front().nose)};
  for (std::size_t i = 1; i < samples.size(); ++i)
    ups.push_back(transported(ups.back(), samples[i - 1].nose, samples[i].nose));
  return ups;
}

glm::dquat rotation_to(const glm::dvec3& nose, const glm::dvec3& up) {
  return normalize(glm::quat_cast(glm::dmat3(nose, cross(nose, up), -up)));  // columns: nose, right wing, down
}

}  // namespace

AttitudeTable::AttitudeTable(const TimedCurve& timed_curve, Bank bank, double bank_limit_rad)
    : AttitudeTable(timed_curve, sampled_path(timed_curve), bank, bank_limit_rad) {}

AttitudeTable::AttitudeTable(const TimedCurve& timed_curve, const PathSamples& path_samples, Bank bank,
                             double bank_limit_rad)
    : nose_(timed_curve, path_samples) {
  const std::vector<FlightSample> samples = samples_of(timed_curve, nose_, nose_.sample_times_s(path_samples));
  const std::vector<UpTarget> targets = up_targets(samples, bank, bank_limit_rad);
  const std::vector<glm::dvec3> ups = transported_ups(samples);
  std::vector<DesiredRoll> desired_rolls;
  for (std::size_t i = 0; i < samples.size(); ++i)
    desired_rolls.push_back(
        {samples[i].time_s, signed_angle(ups[i], targets[i].up, samples[i].nose), targets[i].weight});
  const std::vector<double> roll_rad = smoothed_roll_rad(desired_rolls);
  for (std::size_t i = 0; i < samples.size(); ++i)
    entries_.push_back({samples[i].time_s, samples[i].nose, ups[i], roll_rad[i]});
}

glm::dquat AttitudeTable::world_from_body(double time_s, const glm::dvec3& velocity_mps) const {
  const double inside_s = std::clamp(time_s, entries_.front().time_s, entries_.back().time_s);
  const auto after = std::upper_bound(entries_.begin() + 1, entries_.end() - 1, inside_s,
                                      [](double value, const Entry& entry) { return value < entry.time_s; });
  const Entry& before = *std::prev(after);
  const glm::dvec3 nose = nose_.at(inside_s, velocity_mps);
  const glm::dvec3 unrolled = transported(before.transported_up, before.nose, nose);
  return rotation_to(nose, turned(unrolled, nose, roll_rad_at(std::size_t(&before - entries_.data()), inside_s)));
}

// Cubic Hermite between two entries: smooth, and the rates come from the entries around.
double AttitudeTable::roll_rad_at(std::size_t before, double time_s) const {
  const double gap_s = entries_[before + 1].time_s - entries_[before].time_s;
  const double share = (time_s - entries_[before].time_s) / gap_s;
  const double rise_rad = entries_[before + 1].roll_rad - entries_[before].roll_rad;
  const double early_rad = gap_s * roll_rate_at_entry(before) - rise_rad;
  const double late_rad = rise_rad - gap_s * roll_rate_at_entry(before + 1);
  return entries_[before].roll_rad + share * rise_rad +
         share * (1 - share) * ((1 - share) * early_rad + share * late_rad);
}

// Slope of the parabola through an entry and its neighbours (Bessel); at both ends the flight lies still.
double AttitudeTable::roll_rate_at_entry(std::size_t i) const {
  if (i == 0 || i + 1 == entries_.size()) return 0;
  const double before_s = entries_[i].time_s - entries_[i - 1].time_s;
  const double after_s = entries_[i + 1].time_s - entries_[i].time_s;
  return (roll_rate_between(i - 1) * after_s + roll_rate_between(i) * before_s) / (before_s + after_s);
}

double AttitudeTable::roll_rate_between(std::size_t i) const {
  return (entries_[i + 1].roll_rad - entries_[i].roll_rad) / (entries_[i + 1].time_s - entries_[i].time_s);
}

}  // namespace sigs
