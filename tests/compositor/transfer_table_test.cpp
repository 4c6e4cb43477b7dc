// SPDX-License-Identifier: MIT
#include "compositor/transfer_table.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compositor/synthetic_frames.h"

namespace sigs::test {
namespace {

constexpr double kTenthOfAThousandth = 1e-4;  // of a code value of 8 bits: what the header promises

double mirrored(double (*curve)(double), double x) {
  return std::copysign(curve(std::abs(x)), x);
}

}  // namespace

TEST_CASE("light becomes code values as the standard says to a ten-thousandth of a code value") {
  double worst = 0;
  for (double linear = 1e-9; linear < 40; linear *= 1.0001)
    for (const double sign : {1.0, -1.0}) {
      const auto x = static_cast<float>(sign * linear);
      const double off = transfer_table(TransferFunction::srgb).display_of_linear(x) - mirrored(display_value, x);
      // Beyond white by far it is float's own seven digits that count.
      worst = std::max(worst, 255 * std::abs(off) / std::max(1.0, std::abs(mirrored(display_value, x))));
    }
  CHECK(worst < kTenthOfAThousandth);
  CHECK(worst > 0);
}

TEST_CASE("code values become light that is right to a ten-thousandth of a code value") {
  double worst = 0;
  for (int i = -60'000; i <= 330'000; ++i) {
    const auto x = static_cast<float>(i * (1.0 / 200'000));
    const double light = transfer_table(TransferFunction::srgb).linear_of_display(x);
    worst = std::max(worst, 255 * std::abs(mirrored(display_value, light) - x));
  }
  CHECK(worst < kTenthOfAThousandth);
  CHECK(worst > 0);
}

TEST_CASE("the tables never step back by more than their error") {
  float highest = 0;
  float max_back = 0;
  for (float linear = 1e-5F; linear < 5; linear *= 1.00001F) {
    const float display = transfer_table(TransferFunction::srgb).display_of_linear(linear);
    max_back = std::max(max_back, highest - display);
    highest = std::max(highest, display);
  }
  CHECK(max_back < 4e-7F);  // 1e-4 code values
}

TEST_CASE("the tables hold for zero, for the ends of their pieces and beyond all of them") {
  const TransferTable& table = transfer_table(TransferFunction::srgb);
  CHECK(table.display_of_linear(0) == 0);
  CHECK(table.linear_of_display(0) == 0);
  CHECK(std::abs(table.display_of_linear(1) - 1) < 2.5e-7);  // two steps of a float
  CHECK(std::abs(table.linear_of_display(1) - 1) < 2.5e-7);
  const float huge = std::numeric_limits<float>::max();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float x : {std::nextafter(4.0F, 0.0F), 4.0F, std::nextafter(4.0F, 5.0F), 1e4F, 1e20F}) {
    CHECK(table.display_of_linear(x) == doctest::Approx(display_value(x)).epsilon(1e-6));
    CHECK(table.display_of_linear(-x) == -table.display_of_linear(x));
  }
  for (const float x : {std::nextafter(4.0F, 0.0F), 4.0F, 1e4F})
    CHECK(table.linear_of_display(x) == doctest::Approx(linear_value(x)).epsilon(1e-5));  // a 2.4th power
  CHECK(std::isfinite(table.display_of_linear(huge)));
  CHECK(table.display_of_linear(infinite) == infinite);
  CHECK(table.linear_of_display(-infinite) == -infinite);
  CHECK(std::isnan(table.display_of_linear(std::numeric_limits<float>::quiet_NaN())));
}

TEST_CASE("every footage's table is its function to a hundredth of a code value") {
  for (const TransferFunction function : {TransferFunction::gamma22, TransferFunction::gamma28,
                                          TransferFunction::linear, TransferFunction::pq, TransferFunction::hlg}) {
    CAPTURE(static_cast<int>(function));
    const TransferTable& table = transfer_table(function);
    double worst_display = 0;
    double worst_light = 0;
    for (double linear = 1e-9; linear < 200; linear *= 1.0003)
      for (const double sign : {1.0, -1.0}) {
        const double display = display_of_linear(function, sign * linear);
        const double off = table.display_of_linear(static_cast<float>(sign * linear)) - display;
        worst_display = std::max(worst_display, 255 * std::abs(off) / std::max(1.0, std::abs(display)));
      }
    for (int i = 200; i <= 380'000; ++i) {  // from 1e-3
      const auto x = static_cast<float>(i * (1.0 / 200'000));
      const double back = display_of_linear(function, table.linear_of_display(x));
      worst_light = std::max(worst_light, 255 * std::abs(back - x));
      REQUIRE(table.linear_of_display(-x) == -table.linear_of_display(x));
    }
    CHECK(worst_display < 0.01);
    CHECK(worst_light < 0.01);
  }
}

}  // namespace sigs::test
