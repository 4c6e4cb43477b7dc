// SPDX-License-Identifier: MIT
#include "encounter/encounter_track.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

using namespace sigs;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.14159265358979323846;

// World Z is down, so the heights of the tests' states are negative Z.
AircraftState aircraft(double north_m, double east_m, double up_m, double vn, double ve, double vu) {
  return {{north_m, east_m, -up_m}, {vn, ve, -vu}};
}

}  // namespace

TEST_CASE("head-on with an offset: each quantity is the closed form's") {
  // Ownship north at 50 m/s, intruder 3000 m ahead, 400 m to the right, 100 m above, south at 70 m/s, sinking 2 m/s.
  const RelativeQuantities q = relative_quantities(aircraft(0, 0, 500, 50, 0, 0), aircraft(3000, 400, 600, -70, 0, -2));
  const double range_m = std::sqrt(3000.0 * 3000 + 400 * 400 + 100 * 100);
  CHECK(q.range_m == doctest::Approx(range_m).epsilon(1e-14));
  CHECK(q.range_rate_mps == doctest::Approx((3000 * -120.0 + 100 * -2.0) / range_m).epsilon(1e-14));
  CHECK(q.closing_speed_mps == -q.range_rate_mps);
  CHECK(q.bearing_rad == doctest::Approx(std::atan2(400, 3000)).epsilon(1e-14));
  CHECK(q.elevation_rad == doctest::Approx(std::atan2(100, std::hypot(3000, 400))).epsilon(1e-14));
  CHECK(q.time_to_closest_s == doctest::Approx(25).epsilon(1e-14));
  CHECK(q.hmd_m == doctest::Approx(400).epsilon(1e-14));
  CHECK(q.vmd_m == doctest::Approx(50).epsilon(1e-14));
  CHECK(q.time_to_coaltitude_s == doctest::Approx(50).epsilon(1e-14));
  CHECK(tau_mod_s(relative_state(aircraft(0, 0, 500, 50, 0, 0), aircraft(3000, 400, 600, -70, 0, -2)), 1000) ==
        doctest::Approx((1000.0 * 1000 - 3000.0 * 3000 - 400.0 * 400) / (3000 * -120.0)).epsilon(1e-14));
}

TEST_CASE("the bearing is against the ownship's course, to the right, whatever the course") {
  for (double course = -3; course < 3.1; course += 0.37)
    for (double bearing = -3.1; bearing < 3.1; bearing += 0.41) {
      const AircraftState own = aircraft(7, -3, 0, 20 * std::cos(course), 20 * std::sin(course), 3);
      const AircraftState intruder =
          aircraft(7 + 900 * std::cos(course + bearing), -3 + 900 * std::sin(course + bearing), 0, 0, 0, 0);
      CHECK(relative_quantities(own, intruder).bearing_rad == doctest::Approx(bearing).epsilon(1e-12));
    }
  // Behind is +180 degrees, not -180.
  CHECK(relative_quantities(aircraft(0, 0, 0, 10, 0, 0), aircraft(-5, 0, 0, 0, 0, 0)).bearing_rad ==
        doctest::Approx(kPi));
}

TEST_CASE("edges without a direction or a rate have the answers that the header states") {
  const AircraftState still = aircraft(1, 2, 100, 0, 0, 0);
  SUBCASE("two that hover") {
    const RelativeQuantities q = relative_quantities(still, aircraft(1, 52, 100, 0, 0, 0));
    CHECK(q.range_m == 50);
    CHECK(q.closing_speed_mps == 0);
    CHECK(q.bearing_rad == doctest::Approx(kPi / 2));  // against world X
    CHECK(q.time_to_closest_s == 0);
    CHECK(q.hmd_m == 50);
    CHECK(q.time_to_coaltitude_s == 0);  // at one height for ever
    CHECK(tau_mod_s(relative_state(still, aircraft(1, 52, 100, 0, 0, 0)), 40) == kInfinity);
    CHECK(tau_mod_s(relative_state(still, aircraft(1, 52, 100, 0, 0, 0)), 50) == 0);
  }
  SUBCASE("identical") {
    const RelativeQuantities q = relative_quantities(still, still);
    for (const double number : {q.range_m, q.range_rate_mps, q.bearing_rad, q.elevation_rad, q.hmd_m, q.vmd_m,
                                q.time_to_closest_s, q.time_to_coaltitude_s})
      CHECK(number == 0);
  }
  SUBCASE("the same place at different velocities: the range can only grow") {
    const RelativeQuantities q = relative_quantities(still, aircraft(1, 2, 100, 3, 4, 0));
    CHECK(q.range_rate_mps == 5);
    CHECK(q.time_to_closest_s == 0);
  }
  SUBCASE("parallel at the same velocity") {
    const RelativeQuantities q = relative_quantities(aircraft(0, 0, 0, 30, 40, 1), aircraft(-60, 80, 30, 30, 40, 1));
    CHECK(q.hmd_m == 100);
    CHECK(q.vmd_m == 30);
    CHECK(q.time_to_coaltitude_s == kInfinity);
  }
  SUBCASE("diverging") {
    const RelativeQuantities q = relative_quantities(still, aircraft(301, 402, 90, 3, 4, -1));
    CHECK(q.hmd_m == 500);
    CHECK(q.vmd_m == -10);
    CHECK(q.time_to_closest_s == 0);
    CHECK(q.time_to_coaltitude_s == kInfinity);
  }
  SUBCASE("straight above and coming down") {
    const RelativeQuantities q = relative_quantities(still, aircraft(1, 2, 400, 0, 0, -6));
    CHECK(q.elevation_rad == doctest::Approx(kPi / 2));
    CHECK(q.bearing_rad == 0);
    CHECK(q.closing_speed_mps == 6);
    CHECK(q.hmd_m == 0);
    CHECK(q.vmd_m == 300);
    CHECK(q.time_to_coaltitude_s == 50);
  }
  SUBCASE("what is not finite is NaN throughout") {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      const RelativeQuantities q = relative_quantities(still, aircraft(bad, 0, 0, 0, 0, 0));
      for (const double number : {q.range_m, q.bearing_rad, q.hmd_m, q.vmd_m, q.time_to_coaltitude_s})
        CHECK(std::isnan(number));
      CHECK(std::isnan(tau_mod_s(relative_state(still, aircraft(0, 0, 0, 0, bad, 0)), 1)));
    }
  }
}

TEST_CASE("1e7 m apart, 1e-9 m/s of closing speed: no digit is lost") {
  // Passes 2 m beside, in a direction that is no axis: s = -1e7 u + 2 w, v = 1e-9 u.
  const RelativeState r{{-1e7 * 0.6 - 2 * 0.8, -1e7 * 0.8 + 2 * 0.6}, {1e-9 * 0.6, 1e-9 * 0.8}, 3, 0};
  const AircraftState own;
  const AircraftState intruder{{r.horizontal_m.x, r.horizontal_m.y, -3}, {r.horizontal_mps.x, r.horizontal_mps.y, 0}};
  const RelativeQuantities q = relative_quantities(own, intruder);
  CHECK(q.time_to_closest_s == doctest::Approx(1e16).epsilon(1e-14));
  // Numbers of 1e7 m have steps of 1.9e-9 m.
  CHECK(q.hmd_m == doctest::Approx(2).epsilon(4e-9));
  CHECK(q.vmd_m == 3);
  CHECK(tau_mod_s(r, 1000) == doctest::Approx((1e14 + 4 - 1e6) / 1e-2).epsilon(1e-13));
}

TEST_CASE("speeds far below any aircraft's do not overflow into nonsense") {
  const RelativeQuantities q = relative_quantities({}, {{1e7, 5, 0}, {-1e-305, 0, 0}});
  CHECK(q.hmd_m == doctest::Approx(1e7));  // the time would overflow: taken as still
  CHECK(q.time_to_closest_s == 0);
  CHECK(std::isfinite(q.vmd_m));
}
