// SPDX-License-Identifier: MIT
#include "ego_motion/attitudes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/least_squares.h"
#include "base/pose.h"
#include "ego_motion/bundle.h"
#include "ego_motion/rotation_fit.h"
#include "synthetic_rays.h"

namespace sigs::test {

namespace {

// The largest error of any frame about any axis, in pixels.
double largest_error_px(const RayFlightSettings& settings) {
  const RayFlight flight = ray_flight(settings);
  const std::vector<FrameRotation> found = rotations_of(flight.frames, flight.times_s, settings.pixel_rad, {});
  double largest = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const glm::dvec3 error = vector_of(glm::conjugate(flight.start_from_camera[k]) * found[k].start_from_camera);
    largest = std::max({largest, std::abs(error.x), std::abs(error.y), std::abs(error.z)});
  }
  return largest / settings.pixel_rad;
}

std::vector<RayPair> turned_pairs(const glm::dquat& turn, int count, double astray) {
  std::mt19937 chance(5);
  std::uniform_real_distribution<double> even(-0.5, 0.5);
  std::vector<RayPair> pairs;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 ray = glm::normalize(glm::dvec3(1, even(chance), even(chance)));
    glm::dvec3 after = turn * ray;
    if (i < astray * count) after = glm::normalize(after + 0.1 * glm::dvec3(0, even(chance), even(chance)));
    pairs.push_back({ray, after});
  }
  return pairs;
}

}  // namespace

TEST_CASE("without noise the rotation of a flight over ground is exact, whatever the parallax") {
  // The adjustment stops at some 1e-3 px.
  CHECK(largest_error_px({.frames = 60, .noise_px = 0}) < 0.02);
}

TEST_CASE("with noise of 0.1 px the rotation is off by less than that, also when the camera shakes, turns or hovers") {
  // 200 features average the noise to some 0.02 px; new features in a turn take over errors of the old ones.
  CHECK(largest_error_px({.frames = 60}) < 0.2);
  CHECK(largest_error_px({.frames = 60, .shake_rad = 0.004}) < 0.2);
  CHECK(largest_error_px({.frames = 60, .speed_mps = 0}) < 0.2);
  CHECK(largest_error_px({.frames = 60, .turn_radps = {0, 0, 0.35}}) < 0.4);
}

TEST_CASE("points that move together do not pull the rotation, though three of ten do") {
  CHECK(largest_error_px({.frames = 60, .moving_share = 0.3}) < 0.3);
}

TEST_CASE("a turn whose rate changes while the rows are exposed is found by the features, with an honest deviation") {
  // At 12 Hz and 2 px of shake: rates of 0.3 rad/s, which change by 25 rad/s in a second; the first and last row are
  // off by 1.5 and 0.6 px, the mean of all rows by 0.2.
  constexpr double kReadout_s = 0.02;
  const RayFlightSettings settings{.frames = 60};
  RayFlight flight = ray_flight(settings);
  std::mt19937 chance(4);
  std::normal_distribution<double> normal(0, 1);
  for (FrameRays& rays : flight.frames) {
    const auto vector = [&] { return glm::dvec3(normal(chance), normal(chance), normal(chance)); };
    const ReadoutTurn turn{.rate_radps = 0.3 * vector(), .rate_change_radps2 = 25.0 * vector()};
    for (RayObservation& o : rays) o.ray = turn_of(-turn.after(kReadout_s * o.row)) * o.ray;
  }
  std::vector<FrameRotation> found = rotations_of(flight.frames, flight.times_s, settings.pixel_rad, {}, kReadout_s);
  for (std::size_t k = 0; k < found.size(); ++k)
    flight.frames[k] = unrolled(flight.frames[k], found[k].readout_turn, kReadout_s);
  found = rotations_of(flight.frames, flight.times_s, settings.pixel_rad, {}, kReadout_s);
  // What is independent from frame to frame: how the error changes.
  double squares = 0, relative = 0;
  glm::dvec3 before(0, 0, 0);
  for (std::size_t k = 1; k < found.size(); ++k) {
    const glm::dvec3 error = vector_of(glm::conjugate(flight.start_from_camera[k]) * found[k].start_from_camera);
    const glm::dmat3 covariance = found[k].own_covariance + found[k - 1].own_covariance;
    squares += squared_length(error - before) / 3;
    relative += glm::dot(error - before, glm::inverse(covariance) * (error - before));
    before = error;
  }
  const auto count = static_cast<double>(found.size() - 1);
  // The noise of 220 features over three unknowns of each row's turn: 0.03 px; two frames: 0.04 px.
  CHECK(std::sqrt(squares / count) / settings.pixel_rad < 0.08);
  // Three in the mean where the deviation is right; it may be 1.7 times too large or 1.4 times too small.
  CHECK(relative / count > 1);
  CHECK(relative / count < 6);
}

TEST_CASE("clouds over two fifths of the image that the wind moves as one do not turn the camera") {
  // In 10 s clouds at 700 m, seen 30 degrees up, move by 320 mrad at 45 m/s: 160 px.
  CHECK(largest_error_px({.frames = 250, .clouds_m = 700}) < 0.5);
  CHECK(largest_error_px({.frames = 250, .clouds_m = 1500, .wind_mps = 15}) < 0.5);
  CHECK(largest_error_px({.frames = 250, .turn_radps = {0, 0, 0.2}, .clouds_m = 700}) < 0.7);
}

TEST_CASE("where clouds far up are all that is seen, it is said that nothing in view is known to stand still") {
  const auto has_ground = [](const RayFlightSettings& settings) {
    const RayFlight flight = ray_flight(settings);
    return rotations_of(flight.frames, flight.times_s, settings.pixel_rad, {}).back().has_ground;
  };
  CHECK_FALSE(has_ground({.clouds_m = 9000, .wind_mps = 20, .pitch_rad = 0.6}));
  CHECK(has_ground({}));
}

TEST_CASE("the ground below is told by parallax, whatever way the camera is turned") {
  std::mt19937 chance(3);
  std::uniform_real_distribution<double> even(-1, 1);
  const glm::dvec3 down = glm::normalize(glm::dvec3(0.3, -0.4, 0.8));
  std::vector<Landmark> landmarks;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(even(chance), even(chance), even(chance)));
    const double below = glm::dot(direction, down);
    landmarks.push_back(
        {.direction = direction, .inverse_depth = below > 0 ? below / 6 * (1 + 0.2 * even(chance)) : 0});
  }
  const auto ground = ground_of(landmarks);
  REQUIRE(ground);
  CHECK(glm::dot(glm::normalize(*ground), down) > 0.999);
  CHECK(1 / glm::length(*ground) == doctest::Approx(6).epsilon(0.05));
  CHECK(trust_of(ground, down) == 1);
  CHECK(trust_of(ground, -down) < 0.1);
  CHECK(trust_of(std::nullopt, -down) == 1);
  CHECK_FALSE(ground_of({}));
}

TEST_CASE("a rotation is found exactly although four of ten pairs are astray") {
  const glm::dquat turn = turn_of({0.02, -0.05, 0.1});
  const auto fit = fitted_rotation(turned_pairs(turn, 100, 0.4), {});
  REQUIRE(fit);
  CHECK(glm::length(vector_of(glm::conjugate(turn) * fit->after_from_before)) < 1e-6);
}

TEST_CASE("too few pairs, one direction alone, and what is no number give no rotation") {
  const glm::dquat turn = turn_of({0, 0, 0.1});
  CHECK_FALSE(fitted_rotation(turned_pairs(turn, 5, 0), {}));
  CHECK_FALSE(fitted_rotation({}, {}));
  std::vector<RayPair> same(50, turned_pairs(turn, 1, 0).front());
  CHECK_FALSE(fitted_rotation(same, {}));
  std::vector<RayPair> bad = turned_pairs(turn, 50, 0);
  for (RayPair& pair : bad) pair.before.x = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(fitted_rotation(bad, {}));
}

}  // namespace sigs::test
