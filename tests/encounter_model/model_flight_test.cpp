// SPDX-License-Identifier: MIT
#include "encounter_model/model_flight.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "base/pose.h"
#include "encounter_model/small_model.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// The same motion in 2000 steps of Gauss's rule with three points: the path as the integral of the velocity.
glm::dvec2 integrated_ne_m(const SampledPoint& point, double after_s) {
  const double nodes[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const double weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double end_s = after_s;
  if (point.acceleration_mps2 < 0) end_s = std::min(after_s, point.speed_mps / -point.acceleration_mps2);
  glm::dvec2 sum(0, 0);
  constexpr int kSteps = 2000;
  const double step_s = end_s / kSteps;
  for (int i = 0; i < kSteps; ++i)
    for (int node = 0; node < 3; ++node) {
      const double t = (i + nodes[node]) * step_s;
      const double heading_rad = point.heading_rad + point.turn_rate_radps * t;
      sum += weights[node] * step_s * (point.speed_mps + point.acceleration_mps2 * t) *
             glm::dvec2(std::cos(heading_rad), std::sin(heading_rad));
    }
  return sum;
}

EncounterModel small_flying() {
  return encounter_model_of(text_of(small_model()), "m.txt").value();
}

}  // namespace

TEST_CASE("the closed form of a second is the integral of the velocity, for all turns and accelerations") {
  for (const double turn_radps : {0.0, 1e-12, 1e-6, -1e-3, 0.05, -0.3, 0.999, 1.001, 3.0, -7.0})
    for (const double acceleration_mps2 : {0.0, 0.5, -1.0, -40.0})
      for (const double after_s : {0.0, 0.25, 1.0, 2.5}) {
        const SampledPoint point{.heading_rad = 0.7,
                                 .speed_mps = 60,
                                 .vertical_speed_mps = -3,
                                 .acceleration_mps2 = acceleration_mps2,
                                 .turn_rate_radps = turn_radps};
        const SampledPoint moved = moved_on(point, after_s);
        const glm::dvec2 exact_m = integrated_ne_m(point, after_s);
        CAPTURE(turn_radps);
        CAPTURE(acceleration_mps2);
        CHECK(std::abs(moved.position_neu_m.x - exact_m.x) < 1e-10);
        CHECK(std::abs(moved.position_neu_m.y - exact_m.y) < 1e-10);
        CHECK(moved.position_neu_m.z == doctest::Approx(-3 * after_s));
        CHECK(moved.speed_mps == doctest::Approx(std::max(0.0, 60 + acceleration_mps2 * after_s)));
      }
}

TEST_CASE("a full circle ends where it began, and its radius is speed over turn rate") {
  const double rate_radps = rad_of_deg(3);  // the standard rate: 120 s for the circle
  SampledPoint point{.speed_mps = 60, .turn_rate_radps = rate_radps};
  for (int second = 0; second < 60; ++second) point = moved_on(point, 1);
  CHECK(std::abs(point.position_neu_m.x) < 1e-9);
  CHECK(point.position_neu_m.y == doctest::Approx(2 * 60 / rate_radps));  // to the right: east
  for (int second = 0; second < 60; ++second) point = moved_on(point, 1);
  CHECK(glm::length(point.position_neu_m) < 1e-9);
}

TEST_CASE("an aircraft whose speed falls to zero stays where it is") {
  const SampledPoint point{.speed_mps = 1, .acceleration_mps2 = -2};
  const SampledPoint stopped = moved_on(point, 1);
  CHECK(stopped.position_neu_m.x == doctest::Approx(0.25));  // v^2 / 2a
  CHECK(stopped.speed_mps == 0);
  CHECK(moved_on(stopped, 1).position_neu_m == stopped.position_neu_m);
}

TEST_CASE("a drawn flight is continuous and flies what the model says, in the file's units") {
  const EncounterModel model = small_flying();
  for (std::uint64_t number = 0; number < 200; ++number) {
    Random random(1, number);
    const ModelFlight track = drawn_flight(model, {.duration_s = 30, .level_step_ft = 0}, random);
    Random again(1, number);
    ModelState state = initial_state(model, again);
    double altitude_ft = state.values[0];
    REQUIRE(track.points.size() == 31);
    for (std::size_t second = 0; second < 31; ++second) {
      if (second > 0) {
        altitude_ft += state.values[2] / 60;
        state = next_state(model, state, again);
      }
      const SampledPoint& point = track.points[second];
      CHECK(point.time_s == static_cast<double>(second));
      CHECK(point.position_neu_m.z == doctest::Approx(altitude_ft * 0.3048));
      CHECK(point.speed_mps == doctest::Approx(state.values[1] * 1852 / 3600));
      CHECK(point.position_neu_m.x == doctest::Approx(point.speed_mps * point.time_s));  // it has no turn rate
    }
    const double half_m = (track.points[3].position_neu_m.z + track.points[4].position_neu_m.z) / 2;
    CHECK(at_time(track, 3.5).position_neu_m.z == doctest::Approx(half_m));
    CHECK(at_time(track, 30).position_neu_m == track.points[30].position_neu_m);
  }
}

TEST_CASE("the altitude of a level flight is a multiple of 500 ft, never the ground; other flights keep theirs") {
  const EncounterModel model = small_flying();
  int level = 0;
  for (std::uint64_t number = 0; number < 500; ++number) {
    Random random(1, number);
    Random again(1, number);
    const double drawn_ft = initial_state(model, again).values[0];
    const ModelFlight track = drawn_flight(model, {.duration_s = 1}, random);
    const double altitude_ft = track.initial_values[0];
    if (track.initial_values[2] != 0 || drawn_ft <= 250) {
      CHECK(altitude_ft == drawn_ft);
    } else {
      ++level;
      CHECK(std::fmod(altitude_ft, 500) == 0);
      CHECK(std::abs(altitude_ft - drawn_ft) <= 250);
      CHECK(altitude_ft > 0);
    }
  }
  CHECK(level > 50);
}

TEST_CASE("flights below the ground or beyond the speeds of the model are drawn anew as often as is allowed") {
  if (!has_real_data()) return say_skipped("no published encounter models");
  const EncounterModel model =
      read_encounter_model(real_data() / "encounters" / "models" / "uncor_1200only_fwse_v1p2.txt").value();
  int outside = 0;
  for (std::uint64_t number = 0; number < 500; ++number) {
    Random random(4, number);
    const ModelFlight free = drawn_flight(model, {.duration_s = 300}, random);
    bool is_inside = true;
    for (const SampledPoint& point : free.points)
      is_inside =
          is_inside && point.position_neu_m.z >= 0 && point.speed_mps > 0 && point.speed_mps < 300 * 1852.0 / 3600;
    CHECK(free.is_within_limits == is_inside);
    outside += is_inside ? 0 : 1;
    Random again(4, number);
    const ModelFlight kept = drawn_flight(model, {.duration_s = 300, .max_redraws = 1000}, again);
    CHECK(kept.is_within_limits);
    CHECK((kept.redraws > 0) == !is_inside);
  }
  CHECK(outside > 0);
}

TEST_CASE("every published model flies, and a seed gives the same bytes") {
  if (!has_real_data()) return say_skipped("no published encounter models");
  for (const std::string& name : published_models()) {
    CAPTURE(name);
    const EncounterModel model = read_encounter_model(real_data() / "encounters" / "models" / name).value();
    REQUIRE(check_can_fly(model));
    const auto bytes = [&](std::uint64_t seed) {
      Random random(seed);
      const ModelFlight track = drawn_flight(model, {.duration_s = 120}, random);
      std::string text(track.points.size() * sizeof(SampledPoint), '\0');
      std::memcpy(text.data(), track.points.data(), text.size());
      return text;
    };
    CHECK(bytes(1) == bytes(1));
    CHECK(bytes(1) != bytes(2));
  }
}

TEST_CASE("a model without altitude, or with a category where a quantity is needed, gives no tracks and says so") {
  EncounterModel model = small_flying();
  model.variables[0].boundaries.clear();
  CHECK(check_can_fly(model).error().text().find("L has no limits") != std::string::npos);
  model.variables[0].label = "G";
  CHECK(check_can_fly(model).error().text().find("no altitude L") != std::string::npos);
}

}  // namespace sigs::test
