// SPDX-License-Identifier: MIT
#include "encounter/planned_approach.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "encounter/encounter.h"

using namespace sigs;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

EncounterTrack camera_straight(const glm::dvec3& velocity_mps) {
  return {.name = "camera", .last_s = 20, .at = [=](double t) {
            return AircraftState{glm::dvec3(10, 20, -150) + t * velocity_mps, velocity_mps};
          }};
}

// Clockwise from above, climbing.
EncounterTrack camera_circling(double radius_m, double speed_mps) {
  return {.name = "camera", .last_s = 20, .at = [=](double t) {
            const double rate = speed_mps / radius_m;
            const double a = rate * t;
            return AircraftState{{radius_m * std::sin(a), radius_m * (1 - std::cos(a)), -150 - 2 * t},
                                 {speed_mps * std::cos(a), speed_mps * std::sin(a), -2}};
          }};
}

// The figures by the search that reads any pair of flights, and by central differences of the positions.
void check_comes_true(const PlannedApproach& wanted, const EncounterTrack& own) {
  const auto flight = planned_flight_of(wanted, own);
  REQUIRE_MESSAGE(flight.has_value(), (flight ? "" : flight.error()));
  const NearestMoment found = encounter_of(own, *flight, {}).value().nearest_horizontal;
  CHECK(std::abs(found.horizontal_m - std::abs(wanted.miss_m)) < 1e-6);
  CHECK(std::abs(found.vertical_m - wanted.vertical_miss_m) < 1e-5);
  CHECK(std::abs(found.time_s - wanted.time_s) < 1e-5);
  const auto apart_m = [&](double t) { return flight->at(t).position_m - own.at(t).position_m; };
  const double h = 1e-4;
  const glm::dvec3 rate_mps = (apart_m(wanted.time_s + h) - apart_m(wanted.time_s - h)) / (2 * h);
  CHECK(std::abs(std::hypot(rate_mps.x, rate_mps.y) - wanted.closing_speed_mps) < 1e-5);
  CHECK(std::abs(-rate_mps.z - wanted.climb_mps) < 1e-5);
}

}  // namespace

TEST_CASE("an intruder from the front passes on the side that is asked for, level with the camera or above it") {
  const EncounterTrack own = camera_straight({30, 0, 0});
  const PlannedApproach wanted{
      .time_s = 8, .miss_m = 60, .vertical_miss_m = 25, .closing_speed_mps = 70, .bearing_rad = 0};
  const auto flight = planned_flight_of(wanted, own);
  REQUIRE(flight.has_value());
  // At 8 s the camera is at X 250: 60 m to its right is Y 80, 25 m above is Z -175. Closing at 70, it flies 40 towards.
  CHECK(glm::distance(flight->at(8).position_m, glm::dvec3(250, 80, -175)) < 1e-9);
  CHECK(glm::distance(flight->at(0).velocity_mps, glm::dvec3(-40, 0, 0)) < 1e-12);
  CHECK(glm::distance(flight->at(0).position_m, glm::dvec3(570, 80, -175)) < 1e-9);
}

TEST_CASE("an intruder from the right passes behind where its miss is to the right, in front where to the left") {
  const EncounterTrack own = camera_straight({30, 0, 0});
  for (const double miss_m : {40.0, -40.0}) {
    const auto flight =
        planned_flight_of({.time_s = 5, .miss_m = miss_m, .closing_speed_mps = 50, .bearing_rad = 90 * kDeg}, own);
    REQUIRE(flight.has_value());
    CHECK(glm::distance(flight->at(5).position_m, glm::dvec3(160 - miss_m, 20, -150)) < 1e-9);
    CHECK(glm::distance(flight->at(5).velocity_mps, glm::dvec3(30, -50, 0)) < 1e-9);
  }
}

TEST_CASE("what is asked for comes true for random encounters with straight and circling cameras") {
  std::mt19937_64 random(16);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int i = 0; i < 300; ++i) {
    const PlannedApproach wanted{.time_s = between(1, 19),
                                 .miss_m = between(-300, 300),
                                 .vertical_miss_m = between(-100, 100),
                                 .closing_speed_mps = between(60, 150),
                                 .climb_mps = between(-8, 8),
                                 .bearing_rad = between(-180, 180) * kDeg};
    check_comes_true(wanted, camera_straight({between(-40, 40), between(-40, 40), between(-3, 3)}));
    check_comes_true(wanted, camera_circling(between(500, 3000), between(10, 30)));
  }
}

TEST_CASE("an approach is read back from the states that it gives, whatever the course") {
  for (const glm::dvec3& velocity_mps : {glm::dvec3(30, 0, 0), glm::dvec3(-10, 25, 1), glm::dvec3(0, 0, -4)}) {
    const AircraftState own{{100, -200, -300}, velocity_mps};
    for (double bearing_deg = -170; bearing_deg <= 180; bearing_deg += 25) {
      const PlannedApproach wanted{.time_s = 3,
                                   .miss_m = -35,
                                   .vertical_miss_m = -12,
                                   .closing_speed_mps = 44,
                                   .climb_mps = 1.5,
                                   .bearing_rad = bearing_deg * kDeg};
      const PlannedApproach found = approach_of(own, intruder_at(wanted, own), 3);
      CHECK(found.time_s == 3);
      CHECK(found.miss_m == doctest::Approx(-35).epsilon(1e-12));
      CHECK(found.vertical_miss_m == doctest::Approx(-12).epsilon(1e-12));
      CHECK(found.closing_speed_mps == doctest::Approx(44).epsilon(1e-12));
      CHECK(found.climb_mps == doctest::Approx(1.5).epsilon(1e-12));
      CHECK(found.bearing_rad == doctest::Approx(bearing_deg * kDeg).epsilon(1e-12));
    }
  }
}

TEST_CASE("two in formation and two in one place have an approach too: no closing speed") {
  const AircraftState own{{0, 0, -100}, {20, 0, 0}};
  const PlannedApproach beside = approach_of(own, {{0, 50, -100}, {20, 0, 0}}, 0);
  CHECK(beside.closing_speed_mps == 0);
  CHECK(beside.miss_m == 50);
  CHECK(glm::distance(intruder_at(beside, own).position_m, glm::dvec3(0, 50, -100)) < 1e-12);
  const PlannedApproach same = approach_of(own, own, 0);
  CHECK(same.miss_m == 0);
  CHECK(same.closing_speed_mps == 0);
}

TEST_CASE("what cannot be is refused with the quantity to change") {
  const EncounterTrack own = camera_straight({30, 0, 0});
  const PlannedApproach possible{.time_s = 8, .miss_m = 60, .closing_speed_mps = 70};
  REQUIRE(planned_flight_of(possible, own).has_value());
  const auto reason = [&](auto change) {
    PlannedApproach wanted = possible;
    change(wanted);
    const auto flight = planned_flight_of(wanted, own);
    return flight ? std::string("possible") : flight.error();
  };
  CHECK(reason([](PlannedApproach& a) { a.time_s = -0.5; }).starts_with("time: -0.5 s is outside of the clip"));
  CHECK(reason([](PlannedApproach& a) { a.time_s = 20.001; }).starts_with("time: "));
  CHECK(reason([](PlannedApproach& a) { a.closing_speed_mps = 0; }).starts_with("closing speed: "));
  CHECK(reason([](PlannedApproach& a) { a.closing_speed_mps = -3; }).starts_with("closing speed: "));
  const std::string vertical = reason([](PlannedApproach& a) {
    a.closing_speed_mps = 0;
    a.climb_mps = 5;
  });
  CHECK(vertical.find("vertical motion alone") != std::string::npos);
  CHECK(reason([](PlannedApproach& a) { a.miss_m = 2e8; }).find("1e8 m") != std::string::npos);
  CHECK(reason([](PlannedApproach& a) { a.closing_speed_mps = 1e9; }).find("1e8 m") != std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(reason([&](PlannedApproach& a) { a.bearing_rad = nan; }).find("not finite") != std::string::npos);
  CHECK(reason([](PlannedApproach& a) { a.time_s = 0; }) == "possible");
  CHECK(reason([](PlannedApproach& a) { a.time_s = 20; }) == "possible");
}

TEST_CASE("a camera that circles an intruder is told the least closing speed") {
  // On a circle of 200 m at 20 m/s the acceleration towards the centre is 2 m/s^2. An intruder 150 m to the right is on
  // that side: v^2 > 150 * 2, so sqrt(300) = 17.32 m/s at least.
  const EncounterTrack own = camera_circling(200, 20);
  PlannedApproach wanted{.time_s = 5, .miss_m = 150, .closing_speed_mps = 17, .bearing_rad = 0};
  const auto refused = planned_flight_of(wanted, own);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().starts_with("closing speed: above 17.3"));
  wanted.miss_m = -150;  // on the outside it is possible
  wanted.closing_speed_mps = 30;
  CHECK(planned_flight_of(wanted, own).has_value());
}

TEST_CASE("the nearest moment alone is that of the whole summary") {
  const EncounterTrack own = camera_circling(300, 15);
  const EncounterTrack intruder = camera_straight({-12, 9, 1});
  const NearestMoment alone = nearest_horizontal_moment(own, intruder).value();
  const NearestMoment of_all = encounter_of(own, intruder, {}).value().nearest_horizontal;
  CHECK(alone.time_s == of_all.time_s);
  CHECK(alone.horizontal_m == of_all.horizontal_m);
  CHECK(alone.vertical_m == of_all.vertical_m);
}
