// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "flights.h"
#include "spline/constant_speed.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

using namespace test;

namespace {

// Length of a polygon through many points of the curve, with Richardson's extrapolation over twice as many.
double brute_length_m(const PiecewiseCubic& curve, int steps) {
  const auto polygon_m = [&](int parts) {
    double sum_m = 0;
    const double duration_s = curve.last_s() - curve.first_s();
    glm::dvec3 before_m = curve.motion_at(curve.first_s()).position_m;
    for (int i = 1; i <= parts; ++i) {
      const glm::dvec3 here_m = curve.motion_at(curve.first_s() + duration_s * i / parts).position_m;
      sum_m += distance(before_m, here_m);
      before_m = here_m;
    }
    return sum_m;
  };
  return (4 * polygon_m(2 * steps) - polygon_m(steps)) / 3;
}

// Distance from a point to the part of the curve near a parameter, by ternary search.
double distance_to_curve_m(const PiecewiseCubic& curve, const glm::dvec3& p_m, double near_s) {
  const auto away_m = [&](double time_s) { return distance(curve.motion_at(time_s).position_m, p_m); };
  double low_s = near_s - 1e-3;
  double high_s = near_s + 1e-3;
  while (high_s - low_s > 1e-12) {
    const double third_s = (high_s - low_s) / 3;
    if (away_m(low_s + third_s) < away_m(high_s - third_s))
      high_s -= third_s;
    else
      low_s += third_s;
  }
  return away_m(low_s);
}

}  // namespace

TEST_CASE("the arc length along a parabola is its closed form") {
  // x = u, z = u^2 / 2: length to u is (u sqrt(1 + u^2) + asinh u) / 2.
  const PiecewiseCubic parabola({0, 2}, {CubicPiece{{{0, 0, 0}, {1, 0, 0}, {0, 0, 0.5}, {0, 0, 0}}}}, {2, 0, 2});
  const ArcLength arc_length(parabola);
  for (const double u : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const double expected_m = (u * std::sqrt(1 + u * u) + std::asinh(u)) / 2;
    CHECK(std::abs(arc_length.arc_length_m_at(u) - expected_m) < 1e-12);
    CHECK(std::abs(arc_length.parameter_s_at(expected_m) - u) < 1e-12);
  }
}

TEST_CASE("the arc length along a cusp is its closed form") {
  // x = u^2, y = u^3 from -1 to 1: both halves are (13 sqrt 13 - 8) / 27 long. In s = u + 1: (s - 1)^2, (s - 1)^3.
  const PiecewiseCubic cusp({0, 2}, {CubicPiece{{{1, -1, 0}, {-2, 3, 0}, {1, -3, 0}, {0, 1, 0}}}}, {1, 1, 0});
  const ArcLength arc_length(cusp);
  const double half_m = (13 * std::sqrt(13.0) - 8) / 27;
  CHECK(std::abs(arc_length.total_m() - 2 * half_m) < 1e-11);  // the kink in the speed costs a digit
  CHECK(std::abs(arc_length.arc_length_m_at(1) - half_m) < 1e-11);
}

TEST_CASE("the whole arc length of wild flights is what a fine polygon measures") {
  for (const unsigned seed : {21U, 22U, 23U}) {
    const PiecewiseCubic curve = interpolating_spline(wild(10, seed));
    const double total_m = ArcLength(curve).total_m();
    CHECK(std::abs(total_m - brute_length_m(curve, 200000)) < 1e-9 * total_m);  // the polygon's error, fourth order
  }
}

TEST_CASE("constant speed is constant and takes the whole time and acceleration is across the path") {
  for (const Flight& flight : all_flights()) {
    INFO(flight.name);
    const PiecewiseCubic curve = interpolating_spline(flight.waypoints);
    const ConstantSpeed timed_curve(curve);
    const double total_m = ArcLength(curve).total_m();
    const double speed_mps = total_m > 0 ? total_m / (curve.last_s() - curve.first_s()) : 0;
    for (int i = -100; i <= 1100; ++i) {
      const Motion motion = timed_curve.motion_at(curve.first_s() + (curve.last_s() - curve.first_s()) * i / 1000.0);
      CHECK(std::abs(length(motion.velocity_mps) - speed_mps) <= 1e-12 * speed_mps);
      const double along = dot(motion.acceleration_mps2, motion.velocity_mps);
      CHECK(std::abs(along) <= 1e-9 * (1 + length(motion.acceleration_mps2)) * speed_mps);
    }
    CHECK(timed_curve.motion_at(curve.first_s()).position_m == curve.motion_at(curve.first_s()).position_m);
    CHECK(timed_curve.motion_at(curve.last_s()).position_m == curve.motion_at(curve.last_s()).position_m);
  }
}

TEST_CASE("constant speed is constant by measured distances too") {
  const PiecewiseCubic curve = interpolating_spline(wild(10, 24));
  const ConstantSpeed timed_curve(curve);
  const double speed_mps = length(timed_curve.motion_at(0).velocity_mps);
  const double step_s = 1e-4;
  for (double time_s = 0.1; time_s < curve.last_s() - 0.1; time_s += 0.01) {
    const Motion here = timed_curve.motion_at(time_s);
    const Motion before = timed_curve.motion_at(time_s - step_s);
    const Motion after = timed_curve.motion_at(time_s + step_s);
    const glm::dvec3 v_mps = (after.position_m - before.position_m) / (2 * step_s);
    const glm::dvec3 a_mps2 = (after.velocity_mps - before.velocity_mps) / (2 * step_s);
    const double bend =
        length(here.acceleration_mps2) / speed_mps;  // rad/s; differences err by its third power, h^2 / 6
    CHECK(distance(v_mps, here.velocity_mps) < 1e-6 * speed_mps * (1 + bend * bend));
    CHECK(distance(a_mps2, here.acceleration_mps2) < 1e-4 * speed_mps * (1 + bend * bend * bend));
  }
}

TEST_CASE("constant speed stays on the curve of the waypoints' own timing") {
  const auto waypoints = wild(8, 25);
  const PiecewiseCubic curve = interpolating_spline(waypoints);
  const ArcLength arc_length(curve);
  const ConstantSpeed timed_curve(curve);
  const double speed_mps = arc_length.total_m() / (curve.last_s() - curve.first_s());
  for (double time_s = 0.05; time_s < curve.last_s(); time_s += 0.1) {
    const glm::dvec3 p_m = timed_curve.motion_at(time_s).position_m;
    CHECK(distance_to_curve_m(curve, p_m, arc_length.parameter_s_at(speed_mps * time_s)) < 1e-9);
  }
}

TEST_CASE("coincident waypoints do not interrupt constant speed") {
  const glm::dvec3 a_m{0, 0, 0};
  const glm::dvec3 b_m{100, 0, 0};
  const PiecewiseCubic line(
      {0, 1, 2, 3, 4},
      {CubicPiece{a_m}, CubicPiece{{a_m, b_m, {0, 0, 0}, {0, 0, 0}}}, CubicPiece{b_m}, CubicPiece{b_m}}, b_m);
  const ConstantSpeed timed_curve(line);
  for (double time_s = -1; time_s < 6; time_s += 0.1)
    CHECK(distance(timed_curve.motion_at(time_s).position_m, {25 * time_s, 0, 0}) < 1e-9);
}

}  // namespace sigs
