// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>
#include <initializer_list>

#include "base/transfer.h"

using namespace sigs;

TEST_CASE("every 8-bit code value comes back from linear light") {
  for (int code = 0; code <= 255; ++code) {
    const float display = static_cast<float>(code) / 255.0F;
    CHECK(std::lround(255.0F * display_of_linear(linear_of_display(display))) == code);
  }
}

TEST_CASE("the transfer function has the known values of the standard") {
  CHECK(linear_of_display(0.0F) == 0.0F);
  CHECK(linear_of_display(1.0F) == doctest::Approx(1.0F).epsilon(1e-6));
  CHECK(linear_of_display(0.5F) == doctest::Approx(0.21404114F).epsilon(1e-5));  // IEC 61966-2-1
  CHECK(linear_of_display(0.04045F) == doctest::Approx(0.0031308F).epsilon(1e-4));
}

TEST_CASE("values below zero and above one follow the curve and its mirror image") {
  for (const float display : {-0.2F, -0.01F, 1.1F, 1.5F}) {
    CHECK(display_of_linear(linear_of_display(display)) == doctest::Approx(display).epsilon(1e-5));
    CHECK(linear_of_display(-display) == -linear_of_display(display));
  }
}
