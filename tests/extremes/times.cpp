// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "extremes/validity.h"
#include "spline/flights.h"
#include "spline/piecewise_cubic.h"
#include "spline/trajectory.h"

namespace sigs::test {
namespace {

constexpr int kLong = 100'000;

// Hundred thousand frames and some.
Scene with_long_footage(Scene scene) {
  scene.footage.times_s.clear();
  for (int frame = 0; frame < kLong + 100; ++frame) scene.footage.times_s.push_back(frame / 25.0);
  scene.last_frame = kLong + 99;
  return scene;
}

// Straight ahead at 60 m, a frame, a hundred thousand frames, and a frame again.
std::vector<TimedWaypoint> frame_and_1e5_frames() {
  const double frame_s = 0.04;
  return {{0, {60, -5, -150}},
          {frame_s, {60.1, -4.9, -150}},
          {frame_s + 4000, {60, 5, -151}},
          {2 * frame_s + 4000, {60.1, 5.1, -151}}};
}

}  // namespace

TEST_CASE("one frame and a hundred thousand frames in one trajectory give valid frames at both ends and between") {
  Scenario scenario({160, 120});
  add_aircraft(scenario, {60, 0, -150});
  Scene scene = with_long_footage(scenario.opened());
  for (const TrajectorySettings& settings : all_settings()) {
    INFO(name_of(settings));
    scene.intruders[0].trajectory = trajectory_through(frame_and_1e5_frames(), settings);
    for (const int frame : {0, 1, 30'000, kLong + 1, kLong + 99}) {
      CAPTURE(frame);
      const ValidFrame valid = valid_frame(scene, frame, even_frame(scenario.size_px(), 100));
      const bool at_waypoint = frame <= 1 || frame == kLong + 1 || frame == kLong + 2;
      if (settings.spline == SplineKind::interpolating && settings.timing == Timing::frames && at_waypoint)
        CHECK(valid.composed.truth.intruders[0].in_image);
    }
  }
}

TEST_CASE("the spline over one frame and a hundred thousand frames is accurate to the last digits") {
  // Three waypoints have a closed form: the middle one's acceleration, worked out in long double.
  const long double h = 0.04L;
  const long double k = 4000;
  const std::vector<TimedWaypoint> waypoints{{0, {0, 0, 0}}, {0.04, {3, 0, 0}}, {4000.04, {9000, 0, 0}}};
  const PiecewiseCubic curve = interpolating_spline(waypoints);
  const long double a = 3 * ((9000.0L - 3) / k - 3 / h) / (h + k);
  for (const long double u : {0.01L, 0.1L, 0.4226497308L, 0.5L, 0.9L, 0.99L}) {
    const long double w = 1 - u;
    const long double x = w * 3 + u * 9000 - k * k / 6 * a * (w - w * w * w);
    const double off_m = curve.motion_at(static_cast<double>(h + u * k)).position_m.x - static_cast<double>(x);
    CHECK(std::abs(off_m) < 1e-9);  // of 1e5 m, at a time that a double has to 1e-12 s, flown through at 75 m/s
  }
}

TEST_CASE("from one waypoint to ten thousand each is passed at its time and the path is well conditioned") {
  for (const int count : {1, 2, 3, 4, 5, 10, 100, 1000, 10'000}) {
    CAPTURE(count);
    std::vector<TimedWaypoint> waypoints = wild(count, 11);
    for (const TrajectorySettings& settings : all_settings()) {
      // Each takes a second or two at ten thousand; two of the eight are enough there.
      if (count == 10'000 && (settings.bank == Bank::level || settings.timing == Timing::constant_speed)) continue;
      INFO(name_of(settings));
      const Trajectory trajectory = trajectory_through(waypoints, settings);
      if (settings.spline == SplineKind::interpolating && settings.timing == Timing::frames)
        for (const TimedWaypoint& waypoint : waypoints)
          REQUIRE(distance(trajectory.position_m(waypoint.time_s), waypoint.position_m) < 1e-9);
      const double last_s = waypoints.back().time_s;
      for (double share = -0.1; share <= 1.1; share += 0.05) {
        const auto pose = trajectory.world_from_body(share * last_s);
        REQUIRE(std::abs(length(pose.rotation) - 1) < 1e-14);
        REQUIRE(is_finite(pose.translation_m));
      }
    }
    for (std::size_t i = 0; i < waypoints.size(); ++i) waypoints[i].time_s = 0.2 * static_cast<double>(i);
    CHECK(interpolation_condition(waypoints) < 2);
  }
}

TEST_CASE("equal frame times give a stationary intruder and times an hour apart a moving one") {
  Scenario scenario;
  add_aircraft(scenario, {60, 0, -150});
  Scene scene = scenario.opened();
  scene.footage.times_s = {0, 0, 3600};  // a clip whose clock stood, then jumped
  scene.intruders[0].trajectory = trajectory_through({{0, {60, -5, -150}}, {3600, {60, 5, -150}}});
  const Frame background = even_frame(scenario.size_px(), 100);
  const ValidFrame first = valid_frame(scene, 0, background);
  const ValidFrame second = valid_frame(scene, 1, background);
  CHECK(same_planes(first.composed.image, second.composed.image));
  CHECK(valid_frame(scene, 2, background).composed.truth.intruders[0].position_m.y == doctest::Approx(5));
}

}  // namespace sigs::test
