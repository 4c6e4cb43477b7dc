// SPDX-License-Identifier: MIT
#include "geo/local_frame.h"

#include <doctest/doctest.h>

#include "base/pose.h"

using namespace sigs;

TEST_CASE("X points along the heading, Y to its right and Z down") {
  const GeodeticPosition origin{33.126, -117.3315, 15};
  const LocalFrame east(origin, rad_of_deg(90));
  CHECK(glm::length(east.world_of(origin)) < 1e-8);
  const glm::dvec3 north = east.world_of({33.127, -117.3315, 15});
  CHECK(north.y < -110);
  CHECK(std::abs(north.x) < 1e-6);
  CHECK(east.world_of({33.126, -117.3315, 25}).z == doctest::Approx(-10).epsilon(1e-9));
}

TEST_CASE("a place comes back from the world") {
  const LocalFrame frame({-20.25, 149.02, 300}, 1);
  const GeodeticPosition place{-20.3, 149.1, 1200};
  const GeodeticPosition back = frame.place_of(frame.world_of(place));
  CHECK(back.latitude_deg == doctest::Approx(place.latitude_deg).epsilon(1e-13));
  CHECK(back.longitude_deg == doctest::Approx(place.longitude_deg).epsilon(1e-13));
  CHECK(back.height_m == doctest::Approx(place.height_m).epsilon(1e-10));
}
