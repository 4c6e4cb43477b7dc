// SPDX-License-Identifier: MIT
#include "appearance/estimate.h"

#include <doctest/doctest.h>

using namespace sigs;

TEST_CASE("an estimate is told with its deviation, or with the reason why there is none") {
  CHECK(estimate_text({.value = 0.45, .sd = 0.031, .is_known = true}, "px") == "0.45 +- 0.031 px");
  CHECK(estimate_text({.value = 12, .sd = 3, .is_known = true}, "") == "12 +- 3");
  CHECK(estimate_text({.value = 0.45, .why = "blank sky"}, "px") == "not known: blank sky; 0.45 px is taken");
}
