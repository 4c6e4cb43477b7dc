// SPDX-License-Identifier: MIT
#include "base/interpolation.h"

#include <doctest/doctest.h>

#include <vector>

#include "base/pose.h"

using namespace sigs;

TEST_CASE("a straight line in time comes back between its samples, and its ends go on beyond them") {
  const std::vector<double> times_s{1, 2, 4};
  const std::vector<double> heights_m{10, 12, 16};  // 2 m/s
  for (const double time_s : {1.0, 1.25, 2.0, 2.5, 3.75, 4.0})
    CHECK(value_at(times_s, heights_m, time_s) == doctest::Approx(8 + 2 * time_s).epsilon(1e-15));
  CHECK(value_at(times_s, heights_m, -100) == 10);
  CHECK(value_at(times_s, heights_m, 100) == 16);
  CHECK(value_at({5}, std::vector<double>{7}, 5.5) == 7);
}

TEST_CASE("at a sample its value comes back to the bit, of several at one time the last") {
  const std::vector<double> times_s{0, 0.1, 0.1, 0.3};
  const std::vector<glm::dquat> turns{rotation_of({0.1, 0.2, 0.3}), rotation_of({1, 0, 0}), rotation_of({0, 0.7, -2}),
                                      rotation_of({0.5, 0.5, 0.5})};
  CHECK(value_at(times_s, turns, 0) == turns[0]);
  CHECK(value_at(times_s, turns, 0.1) == turns[2]);
  CHECK(value_at(times_s, turns, 0.3) == turns[3]);
}

TEST_CASE("a rotation turns at constant rate, by the shorter way") {
  const std::vector<double> times_s{0, 1};
  const glm::dquat end = rotation_of({.yaw_rad = 2});
  for (const glm::dquat& same : {end, -end}) {  // two signs of one rotation
    const glm::dquat middle = value_at(times_s, std::vector<glm::dquat>{{1, 0, 0, 0}, same}, 0.25);
    CHECK(attitude_of(middle).yaw_rad == doctest::Approx(0.5).epsilon(1e-12));
  }
}

TEST_CASE("neighbours are found by any member that is a time") {
  struct Sample {
    double time_s;
    int value;
  };
  const std::vector<Sample> samples{{0, 3}, {10, 4}, {30, 5}};
  const Neighbours at = neighbours_of(samples, 15, &Sample::time_s);
  CHECK(at.before == 1);
  CHECK(at.after == 2);
  CHECK(at.share == 0.25);
  CHECK(neighbours_of(samples, 31, &Sample::time_s).before == 2);
}
