// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lane_values.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("what is out of view has no size, and does not stretch the scale of what is seen") {
  Survey survey;
  for (const double size_px : {12.0, 40.0, 3600.0, 20.0})
    survey.estimates.push_back({.distance_m = 100,
                                .size_px = size_px,
                                .visibility_state = size_px > 1000 ? VisibilityState::out_of_view
                                                    : size_px > 30 ? VisibilityState::occluded
                                                                   : VisibilityState::in_view});
  const LaneValues sizes = values_of(survey, Lane::size);
  REQUIRE(sizes.values.size() == 4);
  CHECK(sizes.values[1] == 40);
  CHECK(std::isnan(sizes.values[2]));
  CHECK(value_text(Lane::size, sizes.values[2]) == "-");
  CHECK(sizes.minimum == 12);
  CHECK(sizes.maximum == 40);
  CHECK(sizes.scale.high < 100);
  CHECK(values_of(survey, Lane::distance).values == std::vector<double>{100, 100, 100, 100});
}

TEST_CASE("an intruder that is never in view has an empty lane of sizes") {
  Survey survey;
  survey.estimates.resize(3);
  const LaneValues sizes = values_of(survey, Lane::size);
  CHECK(sizes.values.size() == 3);
  CHECK(sizes.minimum == sizes.maximum);
  CHECK(values_of(Survey(), Lane::speed).values.empty());
}
