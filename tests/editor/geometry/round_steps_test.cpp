// SPDX-License-Identifier: MIT
#include "editor/geometry/round_steps.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

namespace sigs::editor {

TEST_CASE("a round step is 1, 2 or 5 times a power of ten and the minimum that suffices") {
  for (double minimum = 1e-6; minimum < 1e9; minimum *= 1.07) {
    const double step = round_step(minimum);
    CAPTURE(minimum);
    CHECK(step >= minimum * (1 - 1e-11));
    CHECK(step < minimum * 2.5000001);
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step * 1.000001)));
    const bool is_round =
        std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 || std::abs(mantissa - 5) < 1e-9;
    CHECK(is_round);
  }
}

TEST_CASE("a step that is round already is kept, in spite of the last digit") {
  for (const double step : {1e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 1000.0, 5e6}) {
    CHECK(round_step(step) == doctest::Approx(step).epsilon(1e-12));
    CHECK(round_step(std::nextafter(step, 1e9)) == doctest::Approx(step).epsilon(1e-12));
    CHECK(round_step(std::nextafter(step, 0)) == doctest::Approx(step).epsilon(1e-12));
  }
  CHECK(round_step(1.01) == 2);
  CHECK(round_step(2.01) == 5);
  CHECK(round_step(5.01) == 10);
}

TEST_CASE("no positive number asks for no step in particular") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double none : {0.0, -3.0, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()})
    CHECK(round_step(none) == 1);
}

TEST_CASE("rounded values have the digits of their step") {
  CHECK(rounded_to(0.31, 0.1) == 0.3);
  CHECK(rounded_to(0.29, 0.05) == 0.3);
  CHECK(rounded_to(-17.4, 5) == -15);
  CHECK(rounded_to(12345678, 1000) == 12346000);
  CHECK(rounded_to(0.44, 0.3) == doctest::Approx(0.3));
  CHECK(rounded_to(100, 40) == 120);
}

}  // namespace sigs::editor
