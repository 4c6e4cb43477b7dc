// SPDX-License-Identifier: MIT
#include "editor/geometry/thinning.h"

#include <doctest/doctest.h>

using namespace sigs::editor;

TEST_CASE("of ten thousand marks on 500 pixels one every three pixels is drawn") {
  Thinning thinning(3);
  int drawn = 0;
  for (int i = 0; i < 10'000; ++i) drawn += thinning.leaves_out({i * 0.05, 7}) ? 0 : 1;
  CHECK(drawn >= 160);
  CHECK(drawn <= 167);
}

TEST_CASE("marks that stand apart are all drawn, and the first one always") {
  Thinning thinning(3);
  for (int i = 0; i < 50; ++i) CHECK_FALSE(thinning.leaves_out({10.0 * i, 0}));
  CHECK_FALSE(Thinning(1e9).leaves_out({0, 0}));
}
