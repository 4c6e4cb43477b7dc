// SPDX-License-Identifier: MIT
#include "spline/attitude.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "base/ensure.h"
#include "base/pose.h"
#include "spline/directions.h"
#include "spline/piecewise_cubic.h"
#include "spline/trajectory.h"

namespace sigs {

namespace {

// A flight at one moment, for choosing the roll.
struct FlightSample {
  double time_s = 0;
  glm::dvec3 nose{1, 0, 0};                 // unit
  glm::dvec3 specific_force_mps2{0, 0, 0};  // acceleration less gravity
};

// The direction in which the aircraft's up axis (body -Z) should point, a unit vector perpendicular to the nose, and
// its weight, 0..1. Weight 0: any roll will do, and `up` is zero.
struct UpTarget {
  glm::dvec3 up{0, 0, 0};
  double weight = 0;
};

// The level up vector: world up, without its part along the nose. Its length is the cosine of the pitch.
glm::dvec3 level_up(const glm::dvec3& nose) {
  return across(kWorldUp, nose);
}

constexpr double kSteep = 0.25;    // cosine of the pitch (75.5 degrees) below which any roll is right
constexpr double kModerate = 0.5;  // cosine of the pitch (60 degrees) above which the bank limit holds in full
constexpr double kNothing = 1e-9;  // length below which a direction is rounding

enum class Side { upright, inverted };

struct Run {
  std::size_t first = 0;
  std::size_t past = 0;
};

bool steep(const FlightSample& sample) {
  return length(level_up(sample.nose)) < kSteep;
}

// The stretches of samples that are not steep.
std::vector<Run> moderate_runs(std::span<const FlightSample> samples) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (steep(samples[i])) continue;
    if (runs.empty() || runs.back().past != i) runs.push_back({i, i});
    runs.back().past = i + 1;
  }
  return runs;
}

Side side_of(const Run& run, std::span<const FlightSample> samples) {
  if (run.first == 0 && run.past == samples.size()) return Side::upright;
  double upward = 0;
  for (std::size_t i = run.first; i < run.past; ++i) {
    const double since_s = samples[i].time_s - samples[i > 0 ? i - 1 : 0].time_s;
    upward += since_s * dot(samples[i].specific_force_mps2, level_up(samples[i].nose));
  }
  return upward < 0 ? Side::inverted : Side::upright;
}

std::vector<Side> sides_of(std::span<const FlightSample> samples) {
  std::vector<Side> sides(samples.size(), Side::upright);
  for (const Run& run : moderate_runs(samples)) {
    const Side side = side_of(run, samples);
    std::fill(sides.begin() + std::ptrdiff_t(run.first), sides.begin() + std::ptrdiff_t(run.past), side);
  }
  return sides;
}

// The bank limit at a pitch: in full up to moderate pitch, none (pi) at steep pitch, smooth between.
double limit_rad(double bank_limit_rad, double cos_pitch) {
  const double share = std::clamp((cos_pitch - kSteep) / (kModerate - kSteep), 0.0, 1.0);
  return std::lerp(std::numbers::pi, bank_limit_rad, share * share * (3 - 2 * share));
}

UpTarget level_target(const FlightSample& sample) {
  const glm::dvec3 level = level_up(sample.nose);
  const double cos_pitch = length(level);
  if (cos_pitch < kNothing) return {};
  return {level / cos_pitch, cos_pitch};
}

UpTarget coordinated_target(const FlightSample& sample, Side side, double bank_limit_rad) {
  glm::dvec3 force_mps2 = across(sample.specific_force_mps2, sample.nose);
  const double strength = length(force_mps2) / kGravity_mps2;
  if (strength < kNothing) return {};
  const double weight = std::min(strength, 1.0);
  const glm::dvec3 level = level_up(sample.nose);
  const double cos_pitch = length(level);
  if (cos_pitch < kSteep) return {normalize(force_mps2), weight};

  const glm::dvec3 middle = (side == Side::inverted ? -level : level) / cos_pitch;
  if (dot(force_mps2, middle) < 0) force_mps2 = -force_mps2;  // pushed, not pulled: still no sideways force
  const double max_rad = limit_rad(bank_limit_rad, cos_pitch);
  const double bank_rad = std::clamp(signed_angle(middle, force_mps2, sample.nose), -max_rad, max_rad);
  return {turned(middle, sample.nose, bank_rad), weight};
}

// samples: in order of time, at least one.
std::vector<UpTarget> up_targets(std::span<const FlightSample> samples, Bank bank, double bank_limit_rad) {
  const std::vector<Side> sides = sides_of(samples);
  std::vector<UpTarget> targets;
  targets.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    targets.push_back(bank == Bank::level ? level_target(samples[i])
                                          : coordinated_target(samples[i], sides[i], bank_limit_rad));
  return targets;
}

constexpr double kWorthless =
    0.01;  // a desired roll of less weight is rounding error, and its number of whole turns arbitrary

// Sets the weight of unreliable desired rolls to zero and adds whole turns to the others.
std::vector<DesiredRoll> unwrapped(std::span<const DesiredRoll> desired_rolls) {
  std::vector<DesiredRoll> result(desired_rolls.begin(), desired_rolls.end());
  const DesiredRoll* before = nullptr;
  for (DesiredRoll& desired : result) {
    if (desired.weight < kWorthless) {
      desired.weight = 0;
      continue;
    }
    if (before)
      desired.roll_rad = before->roll_rad + std::remainder(desired.roll_rad - before->roll_rad, 2 * std::numbers::pi);
    before = &desired;
  }
  return result;
}

// The gradient of the sum, set to zero. A desired roll represents half the time to either neighbour.
std::vector<TridiagonalRow<double>> rows_of(std::span<const DesiredRoll> desired_rolls, double tau_s) {
  std::vector<TridiagonalRow<double>> rows(desired_rolls.size(), {.self = 0});
  for (std::size_t i = 0; i + 1 < desired_rolls.size(); ++i) {
    const double gap_s = desired_rolls[i + 1].time_s - desired_rolls[i].time_s;
    const double rate_weight = tau_s * tau_s / gap_s;
    rows[i].after = rows[i + 1].before = -rate_weight;
    rows[i].self += rate_weight + desired_rolls[i].weight * gap_s / 2;
    rows[i + 1].self += rate_weight + desired_rolls[i + 1].weight * gap_s / 2;
    rows[i].right += desired_rolls[i].weight * gap_s / 2 * desired_rolls[i].roll_rad;
    rows[i + 1].right += desired_rolls[i + 1].weight * gap_s / 2 * desired_rolls[i + 1].roll_rad;
  }
  return rows;
}

}  // namespace

std::vector<double> smoothed_roll_rad(std::span<const DesiredRoll> desired_rolls, double tau_s) {
  ENSURE(desired_rolls.size() >= 2);
  const std::vector<DesiredRoll> clear = unwrapped(desired_rolls);
  if (std::ranges::all_of(clear, [](const DesiredRoll& desired) { return desired.weight == 0; }))
    return std::vector<double>(desired_rolls.size(), 0.0);
  return solved<double>(rows_of(clear, tau_s));
}

namespace {

// In such a turn the nose does not follow the path, so no force determines the bank: it is level.
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

// Slope of the parabola through an entry and its neighbours (Bessel); at both ends the attitude is constant.
double AttitudeTable::roll_rate_at_entry(std::size_t i) const {
  if (i == 0 || i + 1 == entries_.size()) return 0;
  const double before_s = entries_[i].time_s - entries_[i - 1].time_s;
  const double after_s = entries_[i + 1].time_s - entries_[i].time_s;
  return (roll_rate_between(i - 1) * after_s + roll_rate_between(i) * before_s) / (before_s + after_s);
}

double AttitudeTable::roll_rate_between(std::size_t i) const {
  return (entries_[i + 1].roll_rad - entries_[i].roll_rad) / (entries_[i + 1].time_s - entries_[i].time_s);
}

namespace {

constexpr double kFollow_s = 0.5;
constexpr double kStep_s = 0.04;
constexpr double kMaxSteps = 20'000;
constexpr double kSlow_mps = 0.5;  // below, the path has no heading
constexpr double kClear_mps = 2;   // from here on it counts in full
constexpr double kMinLift = 0.2;   // of gravity

// Of drag, 1/m.
double drag_of(AttitudeKind kind) {
  if (kind == AttitudeKind::helicopter) return 2.4e-4;
  return kind == AttitudeKind::multirotor ? 0.020 : 0.0;
}

double first_s_of(const TimedCurve& timed_curve) {
  return std::visit([](const auto& timed) { return timed.first_s(); }, timed_curve);
}

double last_s_of(const TimedCurve& timed_curve) {
  return std::visit([](const auto& timed) { return timed.last_s(); }, timed_curve);
}

DesiredRoll path_heading(double time_s, const glm::dvec3& velocity_mps) {
  const double speed_mps = std::hypot(velocity_mps.x, velocity_mps.y);
  const double weight = std::clamp((speed_mps - kSlow_mps) / (kClear_mps - kSlow_mps), 0.0, 1.0);
  return {time_s, std::atan2(velocity_mps.y, velocity_mps.x), weight};
}

// headings: at least one.
DesiredRoll given_heading(double time_s, std::span<const TimedHeading> headings) {
  const auto after = std::upper_bound(headings.begin(), headings.end(), time_s,
                                      [](double value, const TimedHeading& heading) { return value < heading.time_s; });
  if (after == headings.begin()) return {time_s, headings.front().heading_rad, 1};
  const TimedHeading& before = *std::prev(after);
  if (after == headings.end()) return {time_s, before.heading_rad, 1};
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  const double turn_rad = std::remainder(after->heading_rad - before.heading_rad, 2 * std::numbers::pi);
  return {time_s, before.heading_rad + share * turn_rad, 1};
}

// Roll, pitch and yaw with which the thrust gives the motion.
glm::dvec3 angles_of(const Motion& motion, double heading_rad, const TrajectorySettings& settings) {
  if (settings.attitude == AttitudeKind::balloon) return {0, 0, heading_rad};
  const glm::dvec3 drag_mps2 = drag_of(settings.attitude) * glm::length(motion.velocity_mps) * motion.velocity_mps;
  const glm::dvec3 force_mps2 = specific_force_mps2(motion) + drag_mps2;
  const double ahead = std::cos(heading_rad) * force_mps2.x + std::sin(heading_rad) * force_mps2.y;
  const double right = std::cos(heading_rad) * force_mps2.y - std::sin(heading_rad) * force_mps2.x;
  const double lift = std::max(-force_mps2.z, kMinLift * kGravity_mps2);
  const double limit_rad = std::min(settings.bank_limit_rad, 0.49 * std::numbers::pi);
  const double pitch_rad = std::clamp(-std::atan2(ahead, lift), -limit_rad, limit_rad);
  const double roll_rad = std::clamp(std::atan2(right, std::hypot(ahead, lift)), -limit_rad, limit_rad);
  return {roll_rad, pitch_rad, heading_rad};
}

std::vector<double> smoothed(const std::vector<TimedWaypoint>& angles, int axis) {
  std::vector<DesiredRoll> desired;
  for (const TimedWaypoint& one : angles) desired.push_back({one.time_s, one.position_m[axis], 1});
  return smoothed_roll_rad(desired, kFollow_s);
}

// Angles in place of a position: the spline through them is as smooth.
PiecewiseCubic angles_along(const TimedCurve& timed_curve, const TrajectorySettings& settings) {
  const double first_s = first_s_of(timed_curve);
  const double duration_s = last_s_of(timed_curve) - first_s;
  const auto steps = static_cast<std::size_t>(std::clamp(std::ceil(duration_s / kStep_s), 1.0, kMaxSteps));
  const double step_s = duration_s > 0 ? duration_s / static_cast<double>(steps) : 1.0;  // one waypoint hovers
  std::vector<DesiredRoll> headings;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double time_s = first_s + step_s * static_cast<double>(i);
    headings.push_back(settings.headings.empty() ? path_heading(time_s, motion_at(timed_curve, time_s).velocity_mps)
                                                 : given_heading(time_s, settings.headings));
  }
  const std::vector<double> heading_rad = smoothed_roll_rad(headings, kFollow_s);
  std::vector<TimedWaypoint> angles;
  for (std::size_t i = 0; i <= steps; ++i)
    angles.push_back(
        {headings[i].time_s, angles_of(motion_at(timed_curve, headings[i].time_s), heading_rad[i], settings)});
  const std::vector<double> roll_rad = smoothed(angles, 0);
  const std::vector<double> pitch_rad = smoothed(angles, 1);
  for (std::size_t i = 0; i <= steps; ++i) angles[i].position_m = {roll_rad[i], pitch_rad[i], heading_rad[i]};
  return interpolating_spline(angles);
}

}  // namespace

RotorcraftAttitude::RotorcraftAttitude(const TimedCurve& timed_curve, const TrajectorySettings& settings)
    : angles_(angles_along(timed_curve, settings)) {}

glm::dquat RotorcraftAttitude::world_from_body(double time_s) const {
  const double inside_s = std::clamp(time_s, angles_.first_s(), angles_.last_s());
  const glm::dvec3 angles = angles_.motion_at(inside_s).position_m;
  return rotation_of({angles.x, angles.y, angles.z});
}

}  // namespace sigs
