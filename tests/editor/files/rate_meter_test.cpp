// SPDX-License-Identifier: MIT
#include "editor/preview/background_job.h"

#include <doctest/doctest.h>

using sigs::editor::RateMeter;

TEST_CASE("at a steady rate the rate and the remaining time are exact") {
  RateMeter meter;
  for (int i = 0; i <= 300; ++i) meter.note(100 + i * 0.04, i);
  REQUIRE(meter.rate_hz());
  CHECK(*meter.rate_hz() == doctest::Approx(25).epsilon(1e-9));  // rounding of sums
  CHECK(*meter.left_s(550) == doctest::Approx(10).epsilon(1e-9));
  CHECK(*meter.left_s(300) == 0);
  CHECK(*meter.left_s(0) == 0);
}

TEST_CASE("without any progress no rate is given") {
  RateMeter meter;
  CHECK_FALSE(meter.rate_hz());
  meter.note(5, 0);
  CHECK_FALSE(meter.left_s(100));
  meter.note(5, 3);
  CHECK_MESSAGE(!meter.rate_hz(), "no time has passed");
  meter.note(50, 3);
  CHECK_FALSE(RateMeter().left_s(1));
}

TEST_CASE("a change of rate shows within some ten seconds") {
  RateMeter meter;
  int done = 0;
  double now_s = 0;
  for (; now_s < 60; now_s += 0.01) meter.note(now_s, ++done);
  for (; now_s < 70; now_s += 0.5) meter.note(now_s, ++done);
  CHECK(*meter.rate_hz() == doctest::Approx(2).epsilon(0.1));  // a measurement or two at the window's edge
}
