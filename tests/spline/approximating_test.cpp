// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>

#include "flights.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

using namespace test;

namespace {

// Equation (2) as printed, except for the factor: its i - 2 is i here.
double printed_basis(double t, int i) {
  const double h = 1;
  const auto knot = [](int k) { return static_cast<double>(k); };
  const auto cube = [](double x) { return x * x * x; };
  double value = 0;
  if (t >= knot(i) && t < knot(i + 1)) {
    value = cube(t - knot(i));
  } else if (t >= knot(i + 1) && t < knot(i + 2)) {
    const double x = t - knot(i + 1);
    value = cube(h) + 3 * h * h * x + 3 * h * x * x - 3 * cube(x);
  } else if (t >= knot(i + 2) && t < knot(i + 3)) {
    const double x = knot(i + 3) - t;
    value = cube(h) + 3 * h * h * x + 3 * h * x * x - 3 * cube(x);
  } else if (t >= knot(i + 3) && t < knot(i + 4)) {
    value = cube(knot(i + 4) - t);
  }
  return value / (6 * cube(h));
}

// Equation (1).
glm::dvec3 printed_point_m(const std::vector<TimedWaypoint>& waypoints, double t) {
  glm::dvec3 sum_m{0};
  for (int i = 0; i < static_cast<int>(waypoints.size()); ++i) sum_m += printed_basis(t, i) * waypoints[i].position_m;
  return sum_m;
}

}  // namespace

TEST_CASE("the approximating spline is the paper's equations at every time") {
  for (const int count : {4, 5, 17}) {
    const auto waypoints = wild(count, 11);
    const PiecewiseCubic curve = approximating_spline(waypoints);
    const double first_s = waypoints.front().time_s;
    const double duration_s = waypoints.back().time_s - first_s;
    for (int step = 0; step <= 1000; ++step) {
      const double t = 3 + (count - 3) * (step / 1000.0);  // n + 1 = count
      const glm::dvec3 point_m = curve.motion_at(first_s + duration_s * (step / 1000.0)).position_m;
      CHECK(distance(point_m, printed_point_m(waypoints, t)) < 1e-10);  // rounding of 400 m
    }
  }
}

TEST_CASE("times of the waypoints in between do not matter to the approximating spline") {
  auto waypoints = wild(9, 12);
  const PiecewiseCubic curve = approximating_spline(waypoints);
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) waypoints[i].time_s = waypoints[0].time_s + 0.01 * double(i);
  const PiecewiseCubic same = approximating_spline(waypoints);
  for (double time_s = -1; time_s < 20; time_s += 0.37)
    CHECK(curve.motion_at(time_s).position_m == same.motion_at(time_s).position_m);
}

TEST_CASE("two waypoints make the straight line through both and three begin and end at theirs") {
  const std::vector<TimedWaypoint> two{{1, {0, 0, 0}}, {5, {40, 8, -4}}};
  for (const double time_s : {-3.0, 1.0, 2.5, 5.0, 20.0})
    CHECK(distance(approximating_spline(two).motion_at(time_s).position_m, (time_s - 1) * glm::dvec3(10, 2, -1)) <
          1e-12);
  const std::vector<TimedWaypoint> three{{0, {0, 0, 0}}, {1, {50, 40, 0}}, {4, {100, 0, 0}}};
  const PiecewiseCubic curve = approximating_spline(three);
  CHECK(distance(curve.motion_at(0).position_m, three[0].position_m) < 1e-12);
  CHECK(distance(curve.motion_at(4).position_m, three[2].position_m) < 1e-12);
  CHECK(distance(curve.motion_at(2).position_m, {50, 80.0 / 3, 0}) < 1e-12);  // (0 + 4 * 40 + 0) / 6
  CHECK(length(curve.motion_at(0).acceleration_mps2) < 1e-12);
}

TEST_CASE("far from the origin the approximating spline has the same shape") {
  const auto near = wild(20, 13);
  auto far = near;
  for (TimedWaypoint& waypoint : far) waypoint.position_m += glm::dvec3(1e7);
  for (double time_s = 0; time_s < near.back().time_s; time_s += 0.31) {
    const Motion a = approximating_spline(near).motion_at(time_s);
    const Motion b = approximating_spline(far).motion_at(time_s);
    CHECK(distance(a.position_m + glm::dvec3(1e7), b.position_m) < 2e-8);  // a few times the 1.9e-9 m that 1e7 has
    CHECK(distance(a.acceleration_mps2, b.acceleration_mps2) < 1e-7);
  }
}

}  // namespace sigs
