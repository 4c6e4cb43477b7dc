// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <opencv2/core.hpp>

#include "flights.h"
#include "spline/piecewise_cubic.h"

namespace sigs {

using namespace test;

namespace {

std::vector<TimedWaypoint> moved(std::vector<TimedWaypoint> waypoints, const glm::dvec3& by_m) {
  for (TimedWaypoint& waypoint : waypoints) waypoint.position_m += by_m;
  return waypoints;
}

// The longest leg is 1e5 times the shortest: one frame at 25 per second next to 1e5 of them.
std::vector<TimedWaypoint> uneven() {
  return {{0, {0, 0, -100}},
          {0.04, {3, 1, -100}},
          {4000.04, {9000, 500, -200}},
          {4000.08, {9003, 500, -201}},
          {4000.12, {9006, 501, -201}},
          {8000.12, {0, 300, -150}},
          {8000.16, {-2, 300, -150}}};
}

// Velocities at the waypoints of the natural cubic spline, from continuity of acceleration (the other usual set of
// unknowns) and a dense solver.
cv::Mat dense_velocities_mps(const std::vector<TimedWaypoint>& w) {
  const int n = static_cast<int>(w.size());
  cv::Mat a = cv::Mat::zeros(n, n, CV_64F);
  cv::Mat b = cv::Mat::zeros(n, 3, CV_64F);
  const auto add_leg = [&](int row, int leg, int own,
                           int other) {  // end acceleration of the leg, as 4 v_own + 2 v_other
    const double h_s = w[leg + 1].time_s - w[leg].time_s;
    a.at<double>(row, own) += 4 / h_s;
    a.at<double>(row, other) += 2 / h_s;
    for (int axis = 0; axis < 3; ++axis)
      b.at<double>(row, axis) += 6 * (w[leg + 1].position_m[axis] - w[leg].position_m[axis]) / (h_s * h_s);
  };
  for (int i = 0; i < n; ++i) {
    if (i > 0) add_leg(i, i - 1, i, i - 1);
    if (i + 1 < n) add_leg(i, i, i, i + 1);
  }
  cv::Mat velocities;
  REQUIRE(cv::solve(a, b, velocities, cv::DECOMP_LU));
  return velocities;
}

}  // namespace

TEST_CASE("the interpolating spline passes through every waypoint at its time") {
  for (const auto& waypoints :
       {uneven(), moved(wild(40, 3), {1e7, -1e7, 1e7}), wild(10000, 4), circle(500, 60, 2, -1)}) {
    const PiecewiseCubic curve = interpolating_spline(waypoints);
    double worst_m = 0;
    for (const TimedWaypoint& w : waypoints)
      worst_m = std::max(worst_m, distance(curve.motion_at(w.time_s).position_m, w.position_m));
    CHECK(worst_m < 1e-9);
  }
}

TEST_CASE("position and velocity and acceleration come to the same from both sides of a knot") {
  for (const auto& waypoints : {uneven(), wild(40, 5)}) {
    const PiecewiseCubic curve = interpolating_spline(waypoints);
    for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
      const double step_s = 1e-9 * std::max(1.0, waypoints[i].time_s);  // some tens of the smallest steps of time
      const Motion before = curve.motion_at(waypoints[i].time_s - step_s);
      const Motion after = curve.motion_at(waypoints[i].time_s);
      // What the motion does on its own in the step, with speeds under 1e3 m/s and jerks under 1e6 m/s^3.
      CHECK(distance(before.position_m, after.position_m) < 1e3 * step_s + 1e-9);
      CHECK(distance(before.velocity_mps, after.velocity_mps) < 1e5 * step_s + 1e-9);
      CHECK(distance(before.acceleration_mps2, after.acceleration_mps2) < 1e6 * step_s + 1e-9);
    }
  }
}

TEST_CASE("the interpolating spline is the natural one that a dense solver finds") {
  for (const auto& waypoints : {wild(30, 6), uneven(), wild(3, 7)}) {
    const PiecewiseCubic curve = interpolating_spline(waypoints);
    const cv::Mat expected = dense_velocities_mps(waypoints);
    for (int i = 0; i < expected.rows; ++i) {
      const glm::dvec3 v_mps = curve.motion_at(waypoints[i].time_s).velocity_mps;
      const cv::Mat row = expected.row(i);
      const glm::dvec3 dense_mps{row.at<double>(0), row.at<double>(1), row.at<double>(2)};
      CHECK(distance(v_mps, dense_mps) < 1e-9 * (1 + length(dense_mps)));  // condition 1e5 at worst, times rounding
    }
  }
}

TEST_CASE("both ends of the interpolating spline are free of acceleration and the flight goes straight on") {
  const auto waypoints = wild(8, 8);
  const PiecewiseCubic curve = interpolating_spline(waypoints);
  for (const double end_s : {waypoints.front().time_s, waypoints.back().time_s}) {
    const Motion end = curve.motion_at(end_s);
    CHECK(length(end.acceleration_mps2) < 1e-9);  // rounding of terms of 1e2
    for (const double away_s : {1e-3, 1.0, 1e4}) {
      const double outside_s = end_s == waypoints.front().time_s ? end_s - away_s : end_s + away_s;
      const Motion out = curve.motion_at(outside_s);
      CHECK(out.velocity_mps == end.velocity_mps);
      CHECK(out.acceleration_mps2 == glm::dvec3(0));
      CHECK(distance(out.position_m, end.position_m + (outside_s - end_s) * end.velocity_mps) <
            1e-12 * (1e3 + 1e3 * away_s));
    }
  }
}

TEST_CASE("one waypoint hovers and two make a straight line at one speed") {
  const PiecewiseCubic hover = interpolating_spline(std::vector<TimedWaypoint>{{5, {1, 2, 3}}});
  for (const double time_s : {-1e6, 5.0, 1e6}) {
    CHECK(hover.motion_at(time_s).position_m == glm::dvec3(1, 2, 3));
    CHECK(hover.motion_at(time_s).velocity_mps == glm::dvec3(0));
  }
  const PiecewiseCubic line = interpolating_spline(std::vector<TimedWaypoint>{{1, {0, 0, 0}}, {5, {40, 8, -4}}});
  for (const double time_s : {-3.0, 1.0, 2.5, 5.0, 20.0}) {
    CHECK(distance(line.motion_at(time_s).position_m, (time_s - 1) * glm::dvec3(10, 2, -1)) < 1e-12);
    CHECK(distance(line.motion_at(time_s).velocity_mps, glm::dvec3(10, 2, -1)) < 1e-14);
  }
}

TEST_CASE("one frame next to a hundred thousand frames does not make the spline overshoot") {
  const PiecewiseCubic curve = interpolating_spline(uneven());
  for (const double time_s : {0.01, 0.02, 0.03, 4000.06, 4000.1, 8000.14}) {
    const glm::dvec3 p_m = curve.motion_at(time_s).position_m;
    const auto after = std::ranges::find_if(curve.knots_s(), [&](double knot_s) { return knot_s > time_s; });
    CHECK(distance(p_m, curve.motion_at(*after).position_m) < 5);  // waypoints a frame apart are at most 3.3 m apart
  }
}

}  // namespace sigs
