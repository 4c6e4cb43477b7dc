// SPDX-License-Identifier: MIT
#include "ego_motion/time_offset.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace sigs::test {

namespace {

constexpr double kFrame_s = 0.04;

// A shaking camera: the integral of its rates, and the rates, in closed form.
Eigen::Vector3d angle_at(double t) {
  return {0.02 * std::sin(7.3 * t) + 0.004 * std::sin(31 * t), 0.015 * std::cos(5.1 * t + 0.4 * std::sin(t)),
          0.03 * std::sin(3.7 * t + 2) + 0.003 * std::cos(23 * t)};
}
glm::dvec3 rate_at(double t) {
  return {0.146 * std::cos(7.3 * t) + 0.124 * std::cos(31 * t),
          -0.015 * (5.1 + 0.4 * std::cos(t)) * std::sin(5.1 * t + 0.4 * std::sin(t)),
          0.111 * std::cos(3.7 * t + 2) - 0.069 * std::sin(23 * t)};
}

// What the images show of it.
std::vector<SeenTurn> turns_seen(int frames) {
  std::vector<SeenTurn> turns;
  for (int k = 1; k < frames; ++k) {
    const double from_s = (k - 1) * kFrame_s;
    turns.push_back({from_s, from_s + kFrame_s, angle_at(from_s + kFrame_s) - angle_at(from_s)});
  }
  return turns;
}

// A log at 200 samples a second whose clock shows t + offset_s + drift * (t - middle_s).
Channel<glm::dvec3> log_of(double length_s, double offset_s, double drift, double middle_s) {
  Channel<glm::dvec3> log;
  for (double t = -3; t < length_s + 3; t += 0.005) {
    log.times_s.push_back(t + offset_s + drift * (t - middle_s));
    log.values.push_back(rate_at(t));
  }
  return log;
}

}  // namespace

TEST_CASE("a log's offset is found to a twentieth of a frame, over several seconds too") {
  for (const double offset_s : {0.0, 0.0123, -0.4567, 6.789}) {
    const auto found = time_offset(turns_seen(300), RateIntegral(log_of(12, offset_s, 0, 6)), 10);
    REQUIRE(found);
    CHECK(std::abs(found->offset_s - offset_s) < 0.002);
    CHECK(found->correlation > 0.999);
    CHECK(found->slope == doctest::Approx(1).epsilon(0.01));
    CHECK(std::abs(found->log_time_s(6) - 6 - offset_s) < 0.004);
  }
}

TEST_CASE("a log whose clock runs fast by a thousandth is found to drift by that") {
  const auto found = time_offset(turns_seen(1500), RateIntegral(log_of(60, 0.1, 1e-3, 30)), 1);
  REQUIRE(found);
  CHECK(std::abs(found->offset_s - 0.1) < 0.002);
  CHECK(found->drift == doctest::Approx(1e-3).epsilon(0.1));
  const auto steady = time_offset(turns_seen(1500), RateIntegral(log_of(60, 0.1, 0, 30)), 1);
  REQUIRE(steady);
  CHECK(std::abs(steady->drift) < 2e-5);
}

TEST_CASE("a camera that does not turn, a log elsewhere in time and an empty log say nothing of the offset") {
  std::vector<SeenTurn> still = turns_seen(300);
  for (SeenTurn& turn : still) turn.turn_rad.setZero();
  const RateIntegral rates(log_of(12, 0, 0, 6));
  const auto unmoved = time_offset(still, rates, 1);
  CHECK((!unmoved || unmoved->correlation == 0));  // below what is taken for the same flight
  CHECK_FALSE(time_offset(turns_seen(300), RateIntegral(log_of(12, 1000, 0, 6)), 10));
  CHECK_FALSE(time_offset(turns_seen(300), RateIntegral({}), 10));
  CHECK_FALSE(time_offset({}, rates, 10));
  CHECK_FALSE(time_offset(turns_seen(10), rates, 10));
}

TEST_CASE("rates and times that are no numbers are left out of a log") {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Channel<glm::dvec3> log = log_of(12, 0.25, 0, 6);
  for (std::size_t i = 0; i < log.values.size(); i += 50) log.values[i].y = kNone;
  for (std::size_t i = 25; i < log.values.size(); i += 50) log.times_s[i] = kNone;
  log.values[30].x = std::numeric_limits<double>::infinity();
  const auto found = time_offset(turns_seen(300), RateIntegral(log), 1);
  REQUIRE(found);
  CHECK(std::abs(found->offset_s - 0.25) < 0.002);
}

}  // namespace sigs::test
