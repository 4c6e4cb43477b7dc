// SPDX-License-Identifier: MIT
#include "dataset/encounter.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace sigs;

TEST_CASE("cosine and sine agree with the C library's in long double to the last digits of doubles") {
  for (double angle_deg = -720; angle_deg <= 720; angle_deg += 0.37) {
    const long double angle_rad = static_cast<long double>(angle_deg) * std::numbers::pi_v<long double> / 180;
    const CosSin found = cos_sin_of_deg(angle_deg);
    CHECK(std::abs(static_cast<double>(std::cos(angle_rad)) - found.cos) < 3e-16);
    CHECK(std::abs(static_cast<double>(std::sin(angle_rad)) - found.sin) < 3e-16);
  }
}

TEST_CASE("quarter turns are exact") {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const CosSin found = cos_sin_of_deg(90.0 * quarter);
    const int turn = ((quarter % 4) + 4) % 4;
    CHECK(found.cos == (turn == 0 ? 1 : turn == 2 ? -1 : 0));
    CHECK(found.sin == (turn == 1 ? 1 : turn == 3 ? -1 : 0));
  }
}

TEST_CASE("mirrored angles have mirrored sines, to the bit") {
  for (double angle_deg = 0.1; angle_deg < 360; angle_deg += 1.7) {
    CHECK(cos_sin_of_deg(-angle_deg).cos == cos_sin_of_deg(angle_deg).cos);
    CHECK(cos_sin_of_deg(-angle_deg).sin == -cos_sin_of_deg(angle_deg).sin);
  }
}
