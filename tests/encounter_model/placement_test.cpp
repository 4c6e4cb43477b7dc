// SPDX-License-Identifier: MIT
#include "encounter_model/model_flight.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "base/pose.h"
#include "encounter_model/small_model.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

glm::dvec2 horizontal(const glm::dvec3& neu) {
  return {neu.x, neu.y};
}

glm::dvec2 velocity_of(const SampledPoint& point) {
  return point.speed_mps * glm::dvec2(std::cos(point.heading_rad), std::sin(point.heading_rad));
}

double range_m(const ModelFlight& own, const ModelFlight& intruder, double time_s) {
  return glm::length(horizontal(at_time(intruder, time_s).position_neu_m - at_time(own, time_s).position_neu_m));
}

// Straight flight north, or steadily turning.
ModelFlight steady(double speed_mps, double turn_rate_radps = 0, int duration_s = 60) {
  ModelFlight track;
  SampledPoint point{.position_neu_m = {0, 0, 1000}, .speed_mps = speed_mps, .turn_rate_radps = turn_rate_radps};
  for (int second = 0; second <= duration_s; ++second) {
    point.time_s = second;
    track.points.push_back(point);
    point = moved_on(point, 1);
  }
  return track;
}

// What was asked for, seen in the two tracks.
void check_placed(const ModelFlight& own, const ModelFlight& intruder, const ApproachRequest& asked) {
  const SampledPoint a = at_time(own, asked.time_s);
  const SampledPoint b = at_time(intruder, asked.time_s);
  const glm::dvec2 offset_m = horizontal(b.position_neu_m - a.position_neu_m);
  const glm::dvec2 relative_mps = velocity_of(b) - velocity_of(a);
  CHECK(std::abs(glm::length(offset_m) - std::abs(asked.hmd_m)) < 1e-9);
  CHECK(std::abs(b.position_neu_m.z - a.position_neu_m.z - asked.vmd_m) < 1e-9);
  CHECK(std::abs(glm::dot(offset_m, glm::normalize(relative_mps))) < 1e-9);
  const double from_rad = std::atan2(-relative_mps.y, -relative_mps.x) - a.heading_rad - asked.bearing_rad;
  CHECK(std::abs(std::remainder(from_rad, 2 * std::numbers::pi)) < 1e-6);
  // On the right of the direction it comes from where hmd is positive: clockwise, seen from above.
  const double side = (-relative_mps.x) * offset_m.y - (-relative_mps.y) * offset_m.x;
  if (asked.hmd_m != 0) CHECK((side > 0) == (asked.hmd_m > 0));
  for (const double beside_s : {-1e-2, 1e-2}) {
    const double time_s = asked.time_s + beside_s;
    if (time_s < 0 || time_s > own.duration_s()) continue;
    CHECK(range_m(own, intruder, time_s) > std::abs(asked.hmd_m) - 1e-9);
    if (glm::length(relative_mps) > 1) CHECK(range_m(own, intruder, time_s) > std::abs(asked.hmd_m));
  }
}

bool is_refused(const ModelFlight& own, const ModelFlight& intruder, const ApproachRequest& asked,
                const std::string& words) {
  const Result<ModelFlight> placed = placed_intruder(own, intruder, asked);
  if (placed) return false;
  INFO(placed.error().text());
  CHECK(placed.error().text().find(words) != std::string::npos);
  return true;
}

}  // namespace

TEST_CASE("head-on, crossing and overtaken straight flights meet at the place that geometry gives") {
  const ModelFlight own = steady(50);
  // Head-on at 70 m/s, 100 m to the right: at 40 s the ownship is at north 2000, and closing is 120 m/s.
  const ModelFlight head_on =
      placed_intruder(own, steady(70), {.time_s = 40, .hmd_m = 100, .vmd_m = -30, .bearing_rad = 0}).value();
  CHECK(glm::length(head_on.points[40].position_neu_m - glm::dvec3(2000, 100, 970)) < 1e-9);
  CHECK(glm::length(head_on.points[0].position_neu_m - glm::dvec3(2000 + 70 * 40, 100, 970)) < 1e-9);
  // From the right at equal speeds with a right angle between the courses: it is seen at 45 degrees.
  const ModelFlight crossing = placed_intruder(own, steady(50), {.time_s = 40, .bearing_rad = rad_of_deg(45)}).value();
  CHECK(glm::length(crossing.points[0].position_neu_m - glm::dvec3(2000, 2000, 1000)) < 1e-8);
  // From behind, 20 m/s faster; on the right of one who looks back is the left of the flight.
  const ModelFlight behind =
      placed_intruder(own, steady(70), {.time_s = 40, .hmd_m = 100, .bearing_rad = rad_of_deg(180)}).value();
  CHECK(glm::length(behind.points[40].position_neu_m - glm::dvec3(2000, -100, 1000)) < 1e-9);
  CHECK(glm::length(behind.points[0].position_neu_m - glm::dvec3(2000 - 70 * 40, -100, 1000)) < 1e-8);
}

TEST_CASE("a slower intruder can be overtaken or met head-on: it is met") {
  const ModelFlight placed = placed_intruder(steady(50), steady(20), {.time_s = 10}).value();
  CHECK(glm::length(placed.points[0].position_neu_m - glm::dvec3(500 + 20 * 10, 0, 1000)) < 1e-9);
}

TEST_CASE("a hovering intruder is met from ahead, and a hovering ownship from everywhere") {
  const ApproachRequest ahead{.time_s = 30, .hmd_m = -12, .vmd_m = 5};
  check_placed(steady(50), placed_intruder(steady(50), steady(0), ahead).value(), ahead);
  CHECK(is_refused(steady(50), steady(0), {.time_s = 30, .bearing_rad = 0.1}, "bearing"));
  for (double bearing_rad = -3; bearing_rad <= 3; bearing_rad += 0.5) {
    const ApproachRequest asked{.time_s = 30, .hmd_m = 80, .vmd_m = 5, .bearing_rad = bearing_rad};
    check_placed(steady(0), placed_intruder(steady(0), steady(33), asked).value(), asked);
  }
}

TEST_CASE("flights without a closest approach are refused with the quantity that is to blame") {
  CHECK(is_refused(steady(50), steady(50), {.time_s = 30, .bearing_rad = rad_of_deg(180)}, "bearing"));  // parallel
  CHECK(is_refused(steady(50), steady(50), {.time_s = 30, .bearing_rad = rad_of_deg(100)}, "bearing"));
  CHECK(is_refused(steady(0), steady(0), {.time_s = 30}, "bearing"));
  CHECK(is_refused(steady(50), steady(20), {.time_s = 30, .bearing_rad = rad_of_deg(60)}, "bearing"));
  CHECK(is_refused(steady(50), steady(20), {.time_s = 61}, "time"));
  CHECK(is_refused(steady(50), steady(20), {.time_s = -0.1}, "time"));
  CHECK(is_refused(steady(50), steady(20, 0, 20), {.time_s = 30}, "time"));
  CHECK(is_refused(steady(50), steady(20), {.time_s = std::nan("")}, "time"));
  CHECK(is_refused(steady(50), steady(20), {.hmd_m = INFINITY}, "hmd"));
  CHECK(is_refused(steady(50), steady(20), {.bearing_rad = std::nan("")}, "bearing"));
}

TEST_CASE("far apart and turning towards each other, flights would be farthest, not closest, and that is refused") {
  // Both turn right with 50 m/s * 0.5 rad/s = 25 m/s^2 and meet head-on with 100 m/s. Passing on the right of one
  // another, each turns towards the other: the square of the range is curved by 100^2 - 50 hmd, positive below 200 m.
  CHECK_FALSE(is_refused(steady(50, 0.5), steady(50, 0.5), {.time_s = 30.5, .hmd_m = 199}, ""));
  CHECK(is_refused(steady(50, 0.5), steady(50, 0.5), {.time_s = 30.5, .hmd_m = 201}, "hmd"));
  const ApproachRequest turning_away{.time_s = 30, .hmd_m = -5000};
  check_placed(steady(50, 0.5), placed_intruder(steady(50, 0.5), steady(50, 0.5), turning_away).value(), turning_away);
}

TEST_CASE("pairs of drawn flights have the miss distances, side and bearing that were asked for, to 1e-9 m") {
  const EncounterModel model = encounter_model_of(text_of(small_model()), "m.txt").value();
  const bool is_published = has_real_data();
  const EncounterModel flying =
      is_published
          ? read_encounter_model(real_data() / "encounters" / "models" / "uncor_1200only_fwse_v1p2.txt").value()
          : model;
  int placed_pairs = 0;
  int refused = 0;
  for (std::uint64_t pair = 0; pair < 2000; ++pair) {
    Random random(99, pair);
    const ModelFlight own = drawn_flight(flying, {}, random);
    const ModelFlight intruder = drawn_flight(flying, {}, random);
    const ApproachRequest asked{.time_s = pair % 5 == 0 ? 30 : 60 * random.uniform(),
                                .hmd_m = pair % 7 == 0 ? 0 : 3000 * (random.uniform() - 0.5),
                                .vmd_m = 300 * (random.uniform() - 0.5),
                                .bearing_rad = 2 * std::numbers::pi * (random.uniform() - 0.5)};
    const Result<ModelFlight> placed = placed_intruder(own, intruder, asked);
    if (!placed) {
      ++refused;
      continue;
    }
    ++placed_pairs;
    check_placed(own, *placed, asked);
    // Nothing but place and heading has changed: distances within the track are the same.
    const auto length_m = [](const ModelFlight& track) {
      return glm::length(track.points.back().position_neu_m - track.points.front().position_neu_m);
    };
    CHECK(std::abs(length_m(*placed) - length_m(intruder)) < 1e-9);
  }
  CHECK(placed_pairs > 1000);
  CHECK(refused > 0);  // slower ones from behind
}

}  // namespace sigs::test
