// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>
#include <numbers>

#include "spline/attitude.h"

namespace sigs {

namespace {

template <class Desired, class Weight>
std::vector<DesiredRoll> desired_rolls(double step_s, int count, Desired desired_rad, Weight weight) {
  std::vector<DesiredRoll> all;
  for (int i = 0; i < count; ++i) all.push_back({i * step_s, desired_rad(i * step_s), weight(i * step_s)});
  return all;
}

double one(double) {
  return 1;
}

double wrapped_rad(double rad) {
  return std::remainder(rad, 2 * std::numbers::pi);
}

}  // namespace

TEST_CASE("a steady desired roll is followed exactly and a steadily growing one away from the ends") {
  for (const double roll_rad : smoothed_roll_rad(desired_rolls(
           0.01, 200, [](double) { return 0.7; }, one)))
    CHECK(std::abs(roll_rad - 0.7) < 1e-12);
  const auto growing = smoothed_roll_rad(desired_rolls(
      0.01, 1000, [](double s) { return wrapped_rad(2 * s); }, one));
  for (int i = 300; i < 700; ++i)
    CHECK(std::abs(growing[i] - 0.02 * i) < 1e-7);  // exp(-3 s / 0.15 s) of the ends' effect remains
}

TEST_CASE("a sudden change is smoothed as the closed form of the problem says") {
  const double step_s = 0.001;
  const auto roll_rad = smoothed_roll_rad(desired_rolls(
      step_s, 4000, [](double s) { return s < 1.9995 ? 0.0 : 1.0; }, one));
  for (int i = 0; i < 4000; i += 10) {
    const double since_s = i * step_s - 1.9995;
    const double tail = 0.5 * std::exp(-std::abs(since_s) / 0.15);          // solution of tau^2 r'' = r - desired roll
    CHECK(std::abs(roll_rad[i] - (since_s < 0 ? tail : 1 - tail)) < 1e-4);  // step / tau squared, over eight
  }
}

TEST_CASE("the roll is linear over an interval without weight, and desired rolls of negligible weight do not count") {
  const auto roll_rad = smoothed_roll_rad(desired_rolls(
      0.01, 1001, [](double s) { return s < 3   ? 0.0
                                        : s > 7 ? 1.0
                                                : 1000 * s; },
      [](double s) { return s < 3 || s > 7 ? 1.0 : 1e-4; }));
  for (int i = 320; i < 680; ++i) {
    const double slope = roll_rad[i + 1] - roll_rad[i];
    CHECK(std::abs(slope - (roll_rad[500] - roll_rad[499])) < 1e-12);
    CHECK(slope > 0);
  }
  CHECK(std::abs(roll_rad[500] - 0.5) < 1e-9);  // by symmetry
}

TEST_CASE("without any desired roll of sufficient weight there is no roll") {
  for (const double roll_rad : smoothed_roll_rad(desired_rolls(
           1, 5, [](double s) { return s; }, [](double) { return 0.0; })))
    CHECK(roll_rad == 0);
}

}  // namespace sigs
