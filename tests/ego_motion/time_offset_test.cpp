// SPDX-License-Identifier: MIT
#include "ego_motion/time_offset.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include "synthetic_rays.h"

namespace sigs::test {

namespace {

constexpr double kFrame_s = 0.04;

// A shaking camera: the integral of its rates, and the rates, in closed form.
glm::dvec3 angle_at(double t) {
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

// A camera shaken at random: rates that change at `knots_hz` times a second, linear in between, and a vibration.
struct Shaken {
  std::vector<SeenTurn> turns;
  Channel<glm::dvec3> log;
};
struct Shake {
  double rate_hz = 30;  // frames a second
  int frames = 400;
  double knots_hz = 20;
  double vibration_hz = 0;
  double noise = 0.3;  // of the turns seen, over their standard deviation
  double offset_s = 0;
  double log_from_s = -12;  // of the footage
  double log_to_s = 12;     // after its end
};
Shaken shaken(const Shake& shake, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double length_s = shake.frames / shake.rate_hz;
  std::vector<glm::dvec3> knots;
  for (double t = -15; t < length_s + 16; t += 1 / shake.knots_hz)
    knots.emplace_back(0.2 * normal(random), 0.2 * normal(random), 0.2 * normal(random));
  const auto rate = [&](double t) {
    const double at = std::clamp((t + 15) * shake.knots_hz, 0.0, static_cast<double>(knots.size()) - 1.001);
    const auto i = static_cast<std::size_t>(at);
    const double share = at - std::floor(at);
    return (1 - share) * knots[i] + share * knots[i + 1] +
           glm::dvec3(0.3, 0.1, 0) * (shake.vibration_hz > 0 ? std::sin(6.283185307 * shake.vibration_hz * t) : 0.0);
  };
  Shaken made;
  for (int k = 1; k < shake.frames; ++k) {
    const double from_s = (k - 1) / shake.rate_hz;
    glm::dvec3 turn(0);
    constexpr int kParts = 8;
    for (int i = 0; i < kParts; ++i) turn += rate(from_s + (i + 0.5) / kParts / shake.rate_hz) / shake.rate_hz / 8.0;
    const double sd = shake.noise * 0.15 / shake.rate_hz;
    turn += sd * glm::dvec3(normal(random), normal(random), normal(random));
    made.turns.push_back({from_s, from_s + 1 / shake.rate_hz, {turn.x, turn.y, turn.z}});
  }
  for (double t = shake.log_from_s; t < length_s + shake.log_to_s; t += 0.005) {
    made.log.times_s.push_back(t + shake.offset_s);
    made.log.values.push_back(rate(t));
  }
  return made;
}

}  // namespace

TEST_CASE("the offset found coarse to fine is the one that all steps compared with all turns give") {
  const std::vector<Shake> shakes{{.offset_s = 1.234},
                                  {.noise = 0.8, .offset_s = -9.7},
                                  {.knots_hz = 2, .offset_s = 8.8},
                                  {.rate_hz = 25, .knots_hz = 60, .noise = 0.5, .offset_s = -3.3},
                                  {.rate_hz = 60, .knots_hz = 100, .noise = 0.6, .offset_s = 0.021},
                                  {.rate_hz = 240, .frames = 800, .knots_hz = 150, .offset_s = -6.02},
                                  {.rate_hz = 5, .frames = 100, .offset_s = 4.4},
                                  {.vibration_hz = 7, .noise = 0.5, .offset_s = 2.2},
                                  {.rate_hz = 30, .vibration_hz = 15, .noise = 0.5, .offset_s = -1.1},
                                  {.knots_hz = 0.5, .vibration_hz = 3, .offset_s = 5.5},
                                  {.offset_s = 9.2, .log_from_s = 8, .log_to_s = -2},
                                  {.frames = 2500, .knots_hz = 3, .noise = 1, .offset_s = 7.77},
                                  {.frames = 2000, .noise = 0.6, .offset_s = -0.4, .log_from_s = 50, .log_to_s = -8}};
  for (std::size_t i = 0; i < shakes.size(); ++i) {
    const Shaken made = shaken(shakes[i], static_cast<unsigned>(i));
    const RateIntegral rates(made.log);
    CAPTURE(i);
    const ExhaustiveOffset truth = exhaustive_offset(made.turns, rates, 10);
    const auto found = time_offset(made.turns, rates, 10);
    REQUIRE(found);
    CAPTURE(truth.correlation);
    CHECK(std::abs(found->offset_s - truth.offset_s) < 1e-6);  // the same step; rounding of the sums
    CHECK(std::abs(found->offset_s - shakes[i].offset_s) < 0.02);
  }
}

TEST_CASE("a search for the offset says how far it is, and ends where it is cancelled") {
  const Shaken made = shaken({.frames = 3500, .offset_s = 3}, 1);
  const RateIntegral rates(made.log);
  std::atomic<bool> cancel = false;
  std::vector<double> shares;
  StepControl control{.cancel = &cancel, .progress = [&](double share) { shares.push_back(share); }};
  REQUIRE(time_offset(made.turns, rates, 10, control));
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.front() > 0);
  CHECK(shares.back() == 1);
  // Each report is one offset that was compared with some 1500 turns, or with all: far fewer than 4001 times all.
  CHECK(shares.size() < 2000);
  for (const double until : {0.01, 0.2, 0.6}) {
    cancel = false;
    std::size_t after = 0;
    control.progress = [&](double share) {
      after += cancel ? 1 : 0;
      if (share >= until) cancel = true;
    };
    CHECK_FALSE(time_offset(made.turns, rates, 10, control));
    CHECK(after == 0);
  }
}

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
  for (SeenTurn& turn : still) turn.turn_rad = glm::dvec3(0);
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
