// SPDX-License-Identifier: MIT
#include "truth/occluded_part.h"

#include <doctest/doctest.h>

namespace sigs::test {

TEST_CASE("what the image's border cuts off is not hidden") {
  CHECK(occluded_fraction({.visible_fraction = 0.3, .inside_fraction = 0.3}) == 0);
  CHECK(occluded_fraction({.visible_fraction = 1, .inside_fraction = 1}) == 0);
}

TEST_CASE("the hidden share is one of what lies in the image") {
  CHECK(occluded_fraction({.visible_fraction = 0.25, .inside_fraction = 0.5}) == 0.5);
  CHECK(occluded_fraction({.visible_fraction = 0, .inside_fraction = 0.5}) == 1);
}

TEST_CASE("nothing in the image hides nothing, and rounding never leaves 0 to 1") {
  CHECK(occluded_fraction({.visible_fraction = 0, .inside_fraction = 0}) == 0);
  CHECK(occluded_fraction({.visible_fraction = 0.5000001, .inside_fraction = 0.5}) == 0);
}

TEST_CASE("a twentieth hidden is not yet occluded") {
  CHECK_FALSE(is_occluded({.visible_fraction = 0.96, .inside_fraction = 1}));
  CHECK(is_occluded({.visible_fraction = 0.94, .inside_fraction = 1}));
  CHECK_FALSE(is_occluded({.visible_fraction = 0.1, .inside_fraction = 0.1}));
}

}  // namespace sigs::test
