// SPDX-License-Identifier: MIT
#include "spline/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/ensure.h"
#include "base/pose.h"
#include "spline/attitude.h"
#include "spline/constant_speed.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

namespace {

constexpr double kFarthest_m = 1e12;  // a double still counts tenths of a millimetre there
constexpr double kLatest_s = 1e12;
constexpr double kMinLeg_s = 1e-9;

bool within(const glm::dvec3& v, double limit) {  // false for NaN
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

std::optional<std::string> mistake_in(const TimedWaypoint& waypoint, const TimedWaypoint* before) {
  if (!within(waypoint.position_m, kFarthest_m))
    return "position must be three numbers, each within 1e12 m of the origin";
  if (!(std::abs(waypoint.time_s) <= kLatest_s)) return "time must be a number of seconds within 1e12";
  if (before && !(waypoint.time_s - before->time_s >= kMinLeg_s))
    return fmt::format("time {:f} s must be later than that of the waypoint before, {:f} s", waypoint.time_s,
                       before->time_s);
  return std::nullopt;
}

Result<void> checked(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
  if (waypoints.empty()) return fail("waypoints", "a trajectory needs at least one waypoint", ErrorKind::bad_project);
  for (std::size_t i = 0; i < waypoints.size(); ++i)
    if (const auto mistake = mistake_in(waypoints[i], i > 0 ? &waypoints[i - 1] : nullptr))
      return fail(fmt::format("waypoints[{}]", i), *mistake, ErrorKind::bad_project);
  for (std::size_t i = 0; i < settings.headings.size(); ++i) {
    const TimedHeading& heading = settings.headings[i];
    const bool is_later = i == 0 || heading.time_s > settings.headings[i - 1].time_s;
    if (!std::isfinite(heading.time_s) || !std::isfinite(heading.heading_rad) || !is_later)
      return fail("headings", "must be numbers at times that increase", ErrorKind::bad_project);
  }
  if (!(settings.bank_limit_rad >= 0 && settings.bank_limit_rad <= std::numbers::pi))
    return fail("bank_limit", "must lie between 0 and 180 degrees", ErrorKind::bad_project);
  return {};
}

TimedCurve timed_curve_of(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
  PiecewiseCubic curve =
      settings.spline == SplineKind::interpolating ? interpolating_spline(waypoints) : approximating_spline(waypoints);
  if (settings.timing == Timing::frames) return curve;
  return ConstantSpeed(std::move(curve));
}

}  // namespace

struct Trajectory::Path {
  TimedCurve timed_curve;
  std::variant<AttitudeTable, RotorcraftAttitude, glm::dquat> attitude;  // the last: the same at all times

  Path(TimedCurve timed, const TrajectorySettings& settings)
      : timed_curve(std::move(timed)), attitude(glm::dquat(1, 0, 0, 0)) {
    if (settings.attitude == AttitudeKind::path)
      attitude = AttitudeTable(timed_curve, settings.bank, settings.bank_limit_rad);
    else
      attitude = RotorcraftAttitude(timed_curve, settings);
  }
  Path(TimedCurve timed, const glm::dquat& world_from_body)
      : timed_curve(std::move(timed)), attitude(world_from_body) {}
};

Trajectory::Trajectory(std::shared_ptr<const Path> path) : path_(std::move(path)) {}

Result<Trajectory> Trajectory::make(const std::vector<TimedWaypoint>& waypoints, const TrajectorySettings& settings) {
  if (const Result<void> good = checked(waypoints, settings); !good) return fail(good.error());
  return Trajectory(std::make_shared<const Path>(timed_curve_of(waypoints, settings), settings));
}

Trajectory Trajectory::steady(double time_s, const Pose<frame::World, frame::Body>& world_from_body,
                              const glm::dvec3& velocity_mps) {
  constexpr double kPiece_s = 1;  // any: the curve goes on as a straight line
  const glm::dvec3& from_m = world_from_body.translation_m;
  PiecewiseCubic line({time_s, time_s + kPiece_s}, {CubicPiece{from_m, velocity_mps, glm::dvec3(0), glm::dvec3(0)}},
                      from_m + kPiece_s * velocity_mps);
  return Trajectory(std::make_shared<const Path>(TimedCurve(std::move(line)), world_from_body.rotation));
}

glm::dvec3 Trajectory::position_m(double time_s) const {
  return motion_at(path_->timed_curve, time_s).position_m;
}

glm::dvec3 Trajectory::velocity_mps(double time_s) const {
  return motion_at(path_->timed_curve, time_s).velocity_mps;
}

glm::dvec3 Trajectory::acceleration_mps2(double time_s) const {
  return motion_at(path_->timed_curve, time_s).acceleration_mps2;
}

Pose<frame::World, frame::Body> Trajectory::world_from_body(double time_s) const {
  ENSURE(std::isfinite(time_s));
  const Motion motion = motion_at(path_->timed_curve, time_s);
  if (const auto* const always = std::get_if<glm::dquat>(&path_->attitude)) return {*always, motion.position_m};
  if (const auto* const carried = std::get_if<RotorcraftAttitude>(&path_->attitude))
    return {carried->world_from_body(time_s), motion.position_m};
  return {std::get<AttitudeTable>(path_->attitude).world_from_body(time_s, motion.velocity_mps), motion.position_m};
}

namespace {

constexpr int kMoments = 16;                 // of a leg at which the magnitudes are summed
constexpr int kOvershootSamples = 64;        // of a leg at which its distance from the straight line is measured
constexpr double kMinOvershootShare = 0.01;  // of the longest leg: a smaller overshoot does not count

// Number of waypoints after which a cardinal function's acceleration is negligible: it at least halves from one to the
// next, so 2^-96. The acceleration itself may be 1e20 times larger where a leg is that much shorter than another,
// squared.
constexpr std::size_t kInfluence = 96;

// The rows of interpolating_spline(), eliminated once and solved for many right sides that are nearly all zero.
class CardinalFunctions {
 public:
  explicit CardinalFunctions(std::span<const TimedWaypoint> waypoints) {
    for (std::size_t i = 0; i + 1 < waypoints.size(); ++i)
      durations_s_.push_back(waypoints[i + 1].time_s - waypoints[i].time_s);
    after_.assign(waypoints.size(), 0.0);
    for (std::size_t i = 1; i < durations_s_.size(); ++i) after_[i] = share_after(i) / pivot(i);
  }

  // The sum over all of them of their magnitudes at the moments of each leg.
  [[nodiscard]] std::vector<std::array<double, kMoments>> sums_of_magnitudes() const {
    std::vector<std::array<double, kMoments>> sums(durations_s_.size());
    for (std::size_t waypoint = 0; waypoint <= durations_s_.size(); ++waypoint) add_magnitudes(waypoint, sums);
    return sums;
  }

 private:
  [[nodiscard]] std::size_t last() const { return durations_s_.size(); }
  [[nodiscard]] double both_s(std::size_t i) const { return durations_s_[i - 1] + durations_s_[i]; }
  [[nodiscard]] double share_before(std::size_t i) const { return durations_s_[i - 1] / both_s(i); }
  [[nodiscard]] double share_after(std::size_t i) const { return durations_s_[i] / both_s(i); }
  [[nodiscard]] double pivot(std::size_t i) const { return 2 - share_before(i) * after_[i - 1]; }

  // Right side of row i for the function that is 1 at `waypoint` and 0 at the others.
  [[nodiscard]] double right(std::size_t i, std::size_t waypoint) const {
    if (i == 0 || i == last()) return 0;
    const double before = 1 / durations_s_[i - 1];
    const double after = 1 / durations_s_[i];
    if (waypoint + 1 == i) return 6 * before / both_s(i);
    if (waypoint == i + 1) return 6 * after / both_s(i);
    return waypoint == i ? -6 * (before + after) / both_s(i) : 0.0;
  }

  void add_magnitudes(std::size_t waypoint, std::vector<std::array<double, kMoments>>& sums) const {
    const std::size_t first = waypoint > kInfluence ? waypoint - kInfluence : 0;
    const std::size_t end = std::min(waypoint + kInfluence, last());
    std::vector<double> a(end - first + 1, 0.0);  // accelerations at the waypoints from `first` on
    for (std::size_t i = std::max<std::size_t>(first, 1); i <= end && i < last(); ++i) {
      const double before = i > first ? a[i - first - 1] : 0.0;
      a[i - first] = (right(i, waypoint) - share_before(i) * before) / pivot(i);
    }
    for (std::size_t i = end; i-- > first;) a[i - first] -= after_[i] * a[i - first + 1];
    for (std::size_t leg = first; leg < end; ++leg) {
      const double from = leg == waypoint ? 1.0 : 0.0;
      const double to = leg + 1 == waypoint ? 1.0 : 0.0;
      const double bow = durations_s_[leg] * durations_s_[leg] / 6;
      for (int m = 0; m < kMoments; ++m) {
        const double u = (m + 0.5) / kMoments;
        const double w = 1 - u;
        sums[leg][static_cast<std::size_t>(m)] += std::abs(
            w * from + u * to - bow * ((w - w * w * w) * a[leg - first] + (u - u * u * u) * a[leg - first + 1]));
      }
    }
  }

  std::vector<double> durations_s_;
  std::vector<double> after_;
};

// Upper bound: a curve leaves its chord by an eighth of the greatest acceleration times the duration squared at most.
double max_overshoot_m(const PiecewiseCubic& curve, const TimedWaypoint& from, const TimedWaypoint& to) {
  const double duration_s = to.time_s - from.time_s;
  const double max_mps2 = std::max(length(curve.motion_at(from.time_s).acceleration_mps2),
                                   length(curve.motion_at(to.time_s).acceleration_mps2));
  return max_mps2 * duration_s * duration_s / 8;
}

double overshoot_m_of(const PiecewiseCubic& curve, const TimedWaypoint& from, const TimedWaypoint& to) {
  double farthest_m = 0;
  for (int i = 1; i < kOvershootSamples; ++i) {
    const double time_s = from.time_s + (to.time_s - from.time_s) * i / kOvershootSamples;
    const glm::dvec3 p_m = curve.motion_at(time_s).position_m;
    farthest_m = std::max(farthest_m, distance_to_segment(p_m, from.position_m, to.position_m));
  }
  return farthest_m;
}

}  // namespace

double interpolation_condition(std::span<const TimedWaypoint> waypoints) {
  ENSURE(!waypoints.empty());
  double condition = 1;  // at a waypoint its own function is 1 and all others are 0
  for (const std::array<double, kMoments>& leg : CardinalFunctions(waypoints).sums_of_magnitudes())
    condition = std::max(condition, *std::max_element(leg.begin(), leg.end()));
  return condition;
}

std::vector<Overshoot> overshoots_of(std::span<const TimedWaypoint> waypoints) {
  const PiecewiseCubic curve = interpolating_spline(waypoints);
  std::vector<double> lengths_m;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i)
    lengths_m.push_back(distance(waypoints[i].position_m, waypoints[i + 1].position_m));
  const double min_overshoot_m =
      lengths_m.empty() ? 0 : kMinOvershootShare * *std::max_element(lengths_m.begin(), lengths_m.end());
  std::vector<Overshoot> overshoots;
  for (std::size_t leg = 0; leg < lengths_m.size(); ++leg) {
    const std::size_t first = leg > 0 ? leg - 1 : 0;
    const std::size_t end = std::min(leg + 2, lengths_m.size());
    const double max_leg_m = *std::max_element(lengths_m.begin() + static_cast<std::ptrdiff_t>(first),
                                               lengths_m.begin() + static_cast<std::ptrdiff_t>(end));
    const double limit_m = std::max(max_leg_m, min_overshoot_m);
    if (max_overshoot_m(curve, waypoints[leg], waypoints[leg + 1]) <= limit_m) continue;
    const double overshoot_m = overshoot_m_of(curve, waypoints[leg], waypoints[leg + 1]);
    if (overshoot_m > limit_m) overshoots.push_back({leg, overshoot_m, max_leg_m});
  }
  return overshoots;
}

}  // namespace sigs
