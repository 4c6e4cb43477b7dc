// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "flights.h"
#include "spline/piecewise_cubic.h"
#include "spline/trajectory.h"

namespace sigs::test {
namespace {

constexpr double kFrame_s = 0.04;

std::vector<TimedWaypoint> at_times(const std::vector<double>& times_s) {
  std::vector<TimedWaypoint> waypoints;
  for (const double time_s : times_s) waypoints.push_back({time_s, {0, 0, 0}});
  return waypoints;
}

std::vector<TimedWaypoint> even(int count) {
  std::vector<double> times_s;
  for (int i = 0; i < count; ++i) times_s.push_back(0.7 * i);
  return at_times(times_s);
}

// The same by another method: each cardinal function is a spline of its own, through 1 m at one waypoint and 0
// elsewhere.
double condition_by_cardinal_functions(std::vector<TimedWaypoint> waypoints) {
  constexpr int kMoments = 200;
  for (TimedWaypoint& waypoint : waypoints) waypoint.position_m = {0, 0, 0};
  std::vector<double> sums((waypoints.size() - 1) * kMoments, 0.0);
  for (TimedWaypoint& one : waypoints) {
    one.position_m.x = 1;
    const PiecewiseCubic curve = interpolating_spline(waypoints);
    one.position_m.x = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::size_t leg = i / kMoments;
      const double share = static_cast<double>(i % kMoments) / kMoments;
      const double from_s = waypoints[leg].time_s;
      sums[i] += std::abs(curve.motion_at(from_s + share * (waypoints[leg + 1].time_s - from_s)).position_m.x);
    }
  }
  return *std::max_element(sums.begin(), sums.end());
}

// One frame at 60 m/s, then 1e5 frames for 9 km, and back to a frame.
std::vector<TimedWaypoint> one_frame_and_1e5() {
  return {{0, {0, 0, -100}},
          {kFrame_s, {2.4, 0, -100}},
          {4000 + kFrame_s, {9000, 0, -100}},
          {4000 + 2 * kFrame_s, {9002.4, 0, -100}}};
}

}  // namespace

TEST_CASE("one waypoint and two have a condition of one") {
  CHECK(interpolation_condition(at_times({5})) == 1);
  CHECK(interpolation_condition(at_times({5, 6})) == doctest::Approx(1).epsilon(1e-12));
  CHECK(interpolation_condition(at_times({0, 1e12})) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("the condition of three waypoints is its closed form whatever their times") {
  // With legs of h and k seconds, h <= k, the middle one's acceleration is 3 (change of mean velocity) / (h + k), and
  // the magnitudes on the longer leg sum to 1 + k^2 (w - w^3) / (h (h + k)), which is greatest for w = 1 / sqrt(3).
  for (const double h_s : {1.0, 0.3, kFrame_s, 1e-9})
    for (const double ratio : {1.0, 2.0, 10.0, 1e5, 1e12}) {
      CAPTURE(h_s);
      CAPTURE(ratio);
      const double k_s = h_s * ratio;
      const double closed = 1 + 2 / (3 * std::sqrt(3)) * ratio * ratio / (1 + ratio);
      CHECK(interpolation_condition(at_times({0, h_s, h_s + k_s})) == doctest::Approx(closed).epsilon(0.005));
      CHECK(interpolation_condition(at_times({0, k_s, k_s + h_s})) == doctest::Approx(closed).epsilon(0.005));
    }
}

TEST_CASE("the condition is that of the cardinal functions themselves") {
  for (const std::vector<TimedWaypoint>& waypoints :
       {even(4), even(5), even(60), wild(30, 7), wild(300, 8), one_frame_and_1e5(),
        at_times({0, 1, 1.001, 2, 5, 5.0001, 9}), at_times({0, 1e-6, 1, 1e6, 1e6 + 1})})
    CHECK(interpolation_condition(waypoints) ==
          doctest::Approx(condition_by_cardinal_functions(waypoints)).epsilon(0.005));
}

TEST_CASE("even times are well conditioned however many waypoints there are") {
  for (const int count : {3, 10, 100, 10000}) {
    CAPTURE(count);
    const double condition = interpolation_condition(even(count));
    CHECK(condition > 1);
    CHECK(condition < 2);
  }
}

TEST_CASE("a leg of one frame next to one of a hundred thousand has a large condition") {
  const double condition = interpolation_condition(one_frame_and_1e5());
  CHECK(condition > 0.3 * 1e5);
  CHECK(condition < 1e6);
}

TEST_CASE("times at the allowed limits have a finite condition") {
  CHECK(std::isfinite(interpolation_condition(at_times({-1e12, 0, 1e-9, 1, 1e12}))));
}

TEST_CASE("the condition bounds how far moved waypoints move the curve and is reached") {
  std::vector<TimedWaypoint> still = wild(12, 5);
  still[6].time_s = still[5].time_s + kFrame_s;  // one stiff place
  const double condition = interpolation_condition(still);
  const PiecewiseCubic before = interpolating_spline(still);
  double farthest_m = 0;
  for (unsigned signs = 0; signs < (1U << 12U); ++signs) {  // every way in which all may move by 1 m
    std::vector<TimedWaypoint> moved = still;
    for (unsigned i = 0; i < 12; ++i) moved[i].position_m.x += (signs >> i & 1U) != 0 ? 1 : -1;
    const PiecewiseCubic after = interpolating_spline(moved);
    for (std::size_t leg = 0; leg + 1 < still.size(); ++leg)
      for (const double share : {0.3, 0.42, 0.5, 0.58, 0.7}) {
        const double time_s = std::lerp(still[leg].time_s, still[leg + 1].time_s, share);
        farthest_m = std::max(farthest_m,
                              std::abs(after.motion_at(time_s).position_m.x - before.motion_at(time_s).position_m.x));
      }
  }
  CHECK(farthest_m <= condition * 1.005);
  CHECK(farthest_m >= condition * 0.98);
}

TEST_CASE("an overshoot beyond the legs around it is found and has its closed form") {
  // A leg of 4000 s that needs 2.25 m/s begins at 60 m/s: with both ends natural the bow is that of three
  // waypoints, acceleration 3 (2.25 - 60) / 4000.04 at the middle one, h^2 / 6 * a * 2 / (3 sqrt(3)) off a straight way
  // that the curve overtakes by so much that it lies beyond its end.
  const std::vector<TimedWaypoint> waypoints{
      {0, {0, 0, -100}}, {kFrame_s, {0, 2.4, -100}}, {4000 + kFrame_s, {9000, 2.4, -100}}};
  const std::vector<Overshoot> overshoots = overshoots_of(waypoints);
  REQUIRE(overshoots.size() == 1);
  CHECK(overshoots[0].leg == 1);
  CHECK(overshoots[0].max_leg_m == doctest::Approx(9000));
  const double off_m = 4000.0 * 4000 / 6 * (3 * 60 / (4000 + kFrame_s)) * 2 / (3 * std::sqrt(3));
  CHECK(overshoots[0].overshoot_m == doctest::Approx(off_m).epsilon(0.001));
}

TEST_CASE("an overshoot counts from the length of the longest leg around it on") {
  for (const double share : {0.97, 1.03}) {
    const double speed_mps = share * 9000 / (4000.0 * 4000 / 2 / (4000 + kFrame_s) * 2 / (3 * std::sqrt(3)));
    const std::vector<TimedWaypoint> waypoints{
        {0, {0, 0, 0}}, {kFrame_s, {0, speed_mps * kFrame_s, 0}}, {4000 + kFrame_s, {9000, speed_mps * kFrame_s, 0}}};
    CHECK(overshoots_of(waypoints).size() == (share > 1 ? 1 : 0));
  }
}

TEST_CASE("the overshoot falls from leg to leg where many waypoints lie at one place") {
  // 100 m legs at 50 m/s, then ten waypoints at one place: from leg to leg of the stop the overshoot falls to 0.27.
  std::vector<TimedWaypoint> waypoints{{0, {0, 0, 0}}, {2, {100, 0, 0}}, {4, {200, 0, 0}}};
  for (int i = 0; i < 10; ++i) waypoints.push_back({6.0 + 2 * i, {200, 0, 0}});
  const std::vector<Overshoot> overshoots = overshoots_of(waypoints);
  REQUIRE(!overshoots.empty());
  CHECK(overshoots.size() <= 4);
  CHECK(overshoots.front().leg == 3);  // the first has a leg of 100 m beside it
  for (const Overshoot& overshoot : overshoots) {
    CHECK(overshoot.max_leg_m == 0);
    CHECK(overshoot.overshoot_m >= 1);  // a hundredth of the longest leg
  }
}

TEST_CASE("a path that follows its waypoints has no overshoot") {
  for (const Flight& flight : all_flights()) {
    INFO(flight.name);
    if (flight.name.find("wild") == std::string::npos) CHECK(overshoots_of(flight.waypoints).empty());
  }
  CHECK(overshoots_of(at_times({0})).empty());
  CHECK(overshoots_of(at_times({0, 1, 1 + 1e-9, 1e5})).empty());  // all at one place
  for (const double turns : {0.5, 2.0}) CHECK(overshoots_of(circle(500, 60, turns, 1)).empty());
}

TEST_CASE("even waypoints however they are scattered never overshoot as far as the legs beside them are long") {
  std::vector<TimedWaypoint> waypoints = wild(10000, 9);
  for (std::size_t i = 0; i < waypoints.size(); ++i) waypoints[i].time_s = 2.0 * static_cast<double>(i);
  CHECK(overshoots_of(waypoints).empty());
}

}  // namespace sigs::test
