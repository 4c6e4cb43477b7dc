// SPDX-License-Identifier: MIT
#include "ego_motion/attitudes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "ego_motion/rotation_fit.h"
#include "synthetic_rays.h"

namespace sigs::test {

namespace {

constexpr int kFrames = 101;
constexpr double kLength_s = 10;

// Linked frames without ground, whose yaw is a function of time; the deviation in each.
std::vector<double> drift_of(
    const std::function<double(double)>& yaw_rad,
    const std::function<bool(int)>& has_ground = [](int) { return false; }) {
  std::vector<FrameRotation> rotations(kFrames);
  std::vector<double> times_s;
  for (int k = 0; k < kFrames; ++k) {
    times_s.push_back(kLength_s * k / (kFrames - 1));
    FrameRotation& r = rotations[static_cast<std::size_t>(k)];
    r.start_from_camera = turn_of({0, 0, yaw_rad(times_s.back())});
    r.has_ground = has_ground(k);
    r.is_linked = k > 0;
  }
  return drift_deviations(rotations, times_s);
}

}  // namespace

TEST_CASE("what turns evenly without parallax may drift by as much, as clouds do at most") {
  const std::vector<double> slow = drift_of([](double t) { return 0.004 * t; });
  CHECK(slow.front() == 0);
  CHECK(slow[50] == doctest::Approx(0.02));
  CHECK(slow.back() == doctest::Approx(0.04));
  CHECK(drift_of([](double t) { return 0.2 * t; }).back() == doctest::Approx(0.1));
  // From frame 41 on there is none.
  CHECK(drift_of([](double t) { return 0.2 * t; }, [](int k) { return k > 40; }).back() == doctest::Approx(0.04));
}

TEST_CASE("what stands still, or moves to and fro, does not drift") {
  CHECK(drift_of([](double) { return 0.0; }).back() == 0);
  // Off by 0.01 sin(30) rad at the end.
  CHECK(drift_of([](double t) { return 0.01 * std::sin(3 * t); }).back() <= 0.01);
  CHECK(drift_deviations({}, {}).empty());
}

TEST_CASE("a camera that hovers over ground is sure of its attitude to a pixel; one below clouds is not") {
  const auto deviation = [](const RayFlightSettings& settings) {
    const RayFlight flight = ray_flight(settings);
    const std::vector<FrameRotation> found = rotations_of(flight.frames, flight.times_s, settings.pixel_rad, {});
    CHECK_FALSE(found.back().has_ground);
    return drift_deviations(found, flight.times_s).back() / settings.pixel_rad;
  };
  CHECK(deviation({.speed_mps = 0, .pitch_rad = -0.7}) < 1);
  CHECK(deviation({.speed_mps = 0, .shake_rad = 0.0005, .pitch_rad = -0.7}) < 1);
  // 20 m/s at 2 km, seen 34 degrees up: 5.7 mrad a second, for 4 s.
  CHECK(deviation({.speed_mps = 0, .clouds_m = 2000, .wind_mps = 20, .pitch_rad = 0.6}) > 8);
}

}  // namespace sigs::test
