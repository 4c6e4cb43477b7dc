// SPDX-License-Identifier: MIT
#include "editor/geometry/light_direction.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <numbers>

namespace sigs::editor {

constexpr double kPi = std::numbers::pi;

TEST_CASE("a light's bearing turns right from world X and its elevation is up") {
  const glm::dvec3 from{100, 200, -150};
  CHECK(direction_of(from + glm::dvec3{10, 0, 0}, from).bearing_rad == 0);
  CHECK(direction_of(from + glm::dvec3{0, 10, 0}, from).bearing_rad == doctest::Approx(kPi / 2));
  CHECK(direction_of(from + glm::dvec3{0, -10, 0}, from).bearing_rad == doctest::Approx(-kPi / 2));
  const LightDirection up = direction_of(from + glm::dvec3{0, 0, -10}, from);
  CHECK(up.elevation_rad == doctest::Approx(kPi / 2));
  CHECK(up.bearing_rad == 0);
  CHECK(up.distance_m == 10);
  CHECK(direction_of(from + glm::dvec3{3, 4, 5}, from).elevation_rad == doctest::Approx(-kPi / 4));
}

TEST_CASE("straight back is bearing +pi from either side of zero") {
  CHECK(direction_of({-1, 0.0, 0}, {0, 0, 0}).bearing_rad == doctest::Approx(kPi));
  CHECK(direction_of({-1, -0.0, 0}, {0, 0.0, 0}).bearing_rad == doctest::Approx(kPi));
  CHECK(direction_of({-1, -1e-300, 0}, {0, 0, 0}).bearing_rad == doctest::Approx(kPi));
}

TEST_CASE("a light at the very place has neither direction nor distance") {
  const LightDirection none = direction_of({4, 5, 6}, {4, 5, 6});
  CHECK((none.bearing_rad == 0 && none.elevation_rad == 0 && none.distance_m == 0));
  CHECK(position_of({1, 1, 0}, {4, 5, 6}) == glm::dvec3{4, 5, 6});
}

TEST_CASE("position and direction are each other's inverse, far and near") {
  for (const double distance_m : {1e-3, 50.0, 1e7})
    for (const double bearing_rad : {-3.1, -0.4, 0.0, 2.0, kPi})
      for (const double elevation_rad : {-1.5, 0.0, 0.3, 1.57}) {
        const glm::dvec3 from{1, -2, 0.5};
        const LightDirection back = direction_of(position_of({bearing_rad, elevation_rad, distance_m}, from), from);
        // A millimetre beside a metre has 13 of a double's 16 digits, and next to the zenith they make up the bearing.
        CHECK(back.bearing_rad == doctest::Approx(bearing_rad).epsilon(1e-8).scale(1));
        CHECK(back.elevation_rad == doctest::Approx(elevation_rad).epsilon(1e-10).scale(1));
        CHECK(back.distance_m == doctest::Approx(distance_m).epsilon(1e-10));
      }
}

}  // namespace sigs::editor
