// SPDX-License-Identifier: MIT
#include "encounter/encounter.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "encounter/brute_force.h"
#include "encounter/smooth_piece.h"

using namespace sigs;

namespace {

EncounterTrack flying_straight(const glm::dvec3& start_m, const glm::dvec3& velocity_mps, double last_s = 200) {
  return {.name = "straight", .last_s = last_s, .at = [=](double t) {
            return AircraftState{start_m + t * velocity_mps, velocity_mps};
          }};
}

EncounterTrack circling(const glm::dvec3& centre_m, double radius_m, double rate_radps, double last_s = 200) {
  return {.name = "circling", .last_s = last_s, .at = [=](double t) {
            const double a = rate_radps * t;
            return AircraftState{centre_m + radius_m * glm::dvec3(std::cos(a), std::sin(a), 0),
                                 radius_m * rate_radps * glm::dvec3(-std::sin(a), std::cos(a), 0)};
          }};
}

EncounterSummary summary_of(const EncounterTrack& own, const EncounterTrack& intruder, const WellClearVolume& volume,
                            std::vector<double> rows_s = {}) {
  return encounter_of(own, intruder, {.volumes = {volume}, .row_times_s = std::move(rows_s)}).value();
}

const WellClearVolume kCylinder{"cylinder", 600, 600, 0, 100, 0};

}  // namespace

TEST_CASE("head-on and overtaking: closest approach and intervals are the closed form's to 1e-9") {
  const WellClearVolume volume{"tau", 600, 600, 35, 100, 0};
  for (const double intruder_mps : {-70.0, 30.0}) {
    const EncounterTrack own = flying_straight({0, 0, -500}, {50, 0, 0}, 400);
    const EncounterTrack intruder = flying_straight({6000, 300, -450}, {intruder_mps, 0, 0}, 400);
    const EncounterSummary summary = summary_of(own, intruder, volume);
    const double speed_mps = 50 - intruder_mps;
    CHECK(std::abs(summary.nearest_horizontal.time_s - 6000 / speed_mps) < 1e-9);
    CHECK(std::abs(summary.nearest_horizontal.horizontal_m - 300) < 1e-9);
    CHECK(summary.nearest_horizontal.vertical_m == -50);
    CHECK(std::abs(summary.nearest.range_m - std::hypot(300, 50)) < 1e-9);
    REQUIRE(summary.volumes[0].losses.size() == 1);
    const TimeInterval loss = summary.volumes[0].losses[0];
    // x = distance ahead: x^2 + 300^2 - T v x = 600^2, and behind on the circle.
    const double flown_m = 35 * speed_mps;
    const double entry_m = (flown_m + std::sqrt(flown_m * flown_m + 4 * (600.0 * 600 - 300 * 300))) / 2;
    CHECK(std::abs(loss.begin_s - (6000 - entry_m) / speed_mps) < 1e-9);
    CHECK(std::abs(loss.end_s - (6000 + std::sqrt(600.0 * 600 - 300 * 300)) / speed_mps) < 1e-9);
    CHECK(summary.nmac.losses.empty());
  }
}

TEST_CASE("a circling intruder comes and goes once in each turn, at the closed form's times to 1e-9") {
  // Circle of 1000 m around a centre 1200 m from a hovering ownship: the distance is the law of cosines.
  const double rate = 0.11;
  const EncounterSummary summary =
      summary_of(flying_straight({0, 0, -100}, {0, 0, 0}), circling({1200, 0, -100}, 1000, rate), kCylinder);
  const double half = std::acos((1200.0 * 1200 + 1000.0 * 1000 - 600.0 * 600) / (2 * 1200.0 * 1000));
  const double pi = std::acos(-1.0);
  int turn = 0;
  for (const TimeInterval& loss : summary.volumes[0].losses) {
    const double middle = (2 * turn++ + 1) * pi;
    CHECK(std::abs(loss.begin_s - (middle - half) / rate) < 1e-9);
    CHECK(std::abs(loss.end_s - std::min(200.0, (middle + half) / rate)) < 1e-9);  // the flight's end cuts the last one
  }
  CHECK(turn == 4);
  CHECK(std::abs(summary.nearest_horizontal.horizontal_m - 200) < 1e-9);
  CHECK(std::abs(summary.nearest_horizontal.time_s - pi / rate) < 1e-6);  // a least value is flat
}

TEST_CASE("a loss of some milliseconds between two samples a second apart is found") {
  SampledTrack own{.name = "own", .samples = {{0, {}}, {1, {}}}};
  // Passes 600 m less 1e-5 m beside, at 100 m/s, in the middle between the samples: half a chord of 0.11 m.
  const double beside_m = 600 - 1e-5;
  SampledTrack intruder{.name = "intruder", .samples = {{0, {{-40, beside_m, 0}, {}}}, {1, {{60, beside_m, 0}, {}}}}};
  const EncounterSummary summary = summary_of(track_of(own), track_of(intruder), kCylinder);
  const double half_s = std::sqrt(600.0 * 600 - beside_m * beside_m) / 100;
  REQUIRE(half_s < 2e-3);
  REQUIRE(summary.volumes[0].losses.size() == 1);
  CHECK(std::abs(summary.volumes[0].losses[0].begin_s - (0.4 - half_s)) < 1e-7);
  CHECK(std::abs(summary.volumes[0].losses[0].end_s - (0.4 + half_s)) < 1e-7);
}

TEST_CASE("brute force over random pairs finds the same intervals") {
  const test::BruteForce compared = test::brute_force(200);
  CHECK(compared.disagreement == "");
  CHECK(compared.losses > 60);
}

TEST_CASE("stiff encounters: slow, far, at one height for ever, identical") {
  SUBCASE("closing at 1e-9 m/s across the limit") {
    const EncounterSummary summary = summary_of(flying_straight({0, 0, 0}, {0, 0, 0}),
                                                flying_straight({600 + 5e-8, 0, 0}, {-1e-9, 0, 0}), kCylinder);
    REQUIRE(summary.volumes[0].losses.size() == 1);
    // 600 m has steps of 1.1e-13 m, that is 1.1e-4 s here.
    CHECK(std::abs(summary.volumes[0].losses[0].begin_s - 50) < 1e-3);
    CHECK(summary.volumes[0].losses[0].end_s == 200);
  }
  SUBCASE("1e7 m apart and closing, and 1e7 m from the origin") {
    const EncounterSummary far = summary_of(flying_straight({0, 0, 0}, {0, 0, 0}),
                                            flying_straight({1e7, 0, 0}, {-1e-9, 0, 0}), kCylinder, {0, 100});
    CHECK(far.volumes[0].losses.empty());
    CHECK(far.rows[0].of_volumes[0].predicted->begin_s == doctest::Approx((1e7 - 600) * 1e9).epsilon(1e-13));
    const EncounterSummary out = summary_of(flying_straight({1e7, -1e7, 0}, {50, 0, 0}),
                                            flying_straight({1e7 + 6000, -1e7, 0}, {-50, 0, 0}), kCylinder);
    CHECK(std::abs(out.volumes[0].losses.at(0).begin_s - 54) < 1e-7);
    CHECK(std::abs(out.volumes[0].losses.at(0).end_s - 66) < 1e-7);
  }
  SUBCASE("fast and far: 1e7 m crossed in the span") {
    const EncounterSummary summary =
        summary_of(flying_straight({0, 0, 0}, {0, 0, 0}), flying_straight({1e7, 10, 0}, {-1e5, 0, 0}), kCylinder);
    CHECK(summary.volumes[0].losses.at(0).begin_s ==
          doctest::Approx(100 - std::sqrt(600.0 * 600 - 100) / 1e5).epsilon(1e-9));
    CHECK(summary.nearest.range_m == doctest::Approx(10).epsilon(1e-6));
  }
  SUBCASE("the same flight twice: lost throughout, severity 100") {
    const EncounterTrack flight = circling({0, 0, -50}, 300, 0.2);
    const EncounterSummary summary = summary_of(flight, flight, kCylinder);
    REQUIRE(summary.volumes[0].losses.size() == 1);
    CHECK(summary.volumes[0].losses[0].begin_s == 0);
    CHECK(summary.volumes[0].losses[0].end_s == 200);
    CHECK(summary.volumes[0].worst_severity == 100);
    CHECK(summary.nmac.losses.size() == 1);
    CHECK(summary.nearest.range_m == 0);
    CHECK(summary.nearest.time_s == 0);
  }
  SUBCASE("in formation exactly at the limits: lost throughout or never, in one piece") {
    const WellClearVolume edge{"edge", 600, 600, 30, 0, 10};
    const EncounterSummary summary =
        summary_of(flying_straight({0, 0, -50}, {30, 20, 0}), flying_straight({600, 0, -50}, {30, 20, 0}), edge);
    CHECK(summary.volumes[0].losses.size() <= 1);
  }
  SUBCASE("around the ownship on the limit itself") {
    const EncounterSummary summary = summary_of(flying_straight({0, 0, -50}, {0, 0, 0}),
                                                circling({0, 0, -50}, 600, 0.3), {"own", 600, 600, 20, 10, 5});
    CHECK(summary.volumes[0].losses.size() < 5000);  // rounding decides, but nothing runs away
  }
}

TEST_CASE("flights at UTC's seconds and 1e9 m from the origin are cut into no more pieces than others") {
  const double start_s = 1.7e9;
  const WellClearVolume kWide{"wide", 800, 800, 20, 100, 0};
  SampledTrack own{.name = "own", .has_velocities = true};
  SampledTrack intruder{.name = "intruder", .has_velocities = true};
  for (int i = 0; i <= 100; ++i) {
    const double a = 0.05 * i;
    const glm::dvec3 origin(1e9, -1e9, 0);
    own.samples.push_back(
        {start_s + i,
         {origin + 800.0 * glm::dvec3(std::cos(a), std::sin(a), 0), 40.0 * glm::dvec3(-std::sin(a), std::cos(a), 0)}});
    intruder.samples.push_back({start_s + i, {origin + glm::dvec3(-1500 + 30.0 * i, 100, 20), {30, 0, 0}}});
  }
  const EncounterTrack a = track_of(own);
  const EncounterTrack b = track_of(intruder);
  int pieces = 0;
  for_each_smooth_piece([&](double t) { return relative_state(a.at(t), b.at(t)); }, start_s, start_s + 100, a.knots_s,
                        1e-15 * 1e9, [&](const SmoothPiece&) { ++pieces; });
  CHECK(pieces == 100);
  const EncounterSummary far = summary_of(a, b, kWide);
  for (SampledTrack* track : {&own, &intruder})
    for (TrackSample& sample : track->samples) {
      sample.time_s -= start_s;
      sample.state.position_m -= glm::dvec3(1e9, -1e9, 0);
    }
  const EncounterSummary near = summary_of(track_of(own), track_of(intruder), kWide);
  REQUIRE(far.volumes[0].losses.size() == near.volumes[0].losses.size());
  REQUIRE(!near.volumes[0].losses.empty());
  for (std::size_t i = 0; i < near.volumes[0].losses.size(); ++i) {
    CHECK(std::abs(far.volumes[0].losses[i].begin_s - start_s - near.volumes[0].losses[i].begin_s) < 1e-6);
    CHECK(std::abs(far.volumes[0].losses[i].end_s - start_s - near.volumes[0].losses[i].end_s) < 1e-6);
  }
}

TEST_CASE("a limit barely wider than the miss gives a brief loss there, one barely narrower none") {
  CHECK(test::grazes(150) == "");
}

TEST_CASE("a corner of a path that is not named as a knot costs no more than 1 ms") {
  // North at 60 m/s, and from 31.337 s on east: tau of a hovering ownship ends there.
  const double corner_s = 31.337;
  EncounterTrack turning{.name = "turning", .last_s = 60, .at = [=](double t) {
                           const double after_s = std::max(0.0, t - corner_s);
                           return AircraftState{{-3000 + 60 * (t - after_s), 60 * after_s, 0},
                                                t < corner_s ? glm::dvec3(60, 0, 0) : glm::dvec3(0, 60, 0)};
                         }};
  const WellClearVolume volume{"tau", 600, 600, 35, 100, 0};
  const EncounterTrack own = flying_straight({0, 0, 0}, {0, 0, 0}, 60);
  const EncounterSummary unnamed = summary_of(own, turning, volume);
  turning.knots_s = {corner_s};
  const EncounterSummary named = summary_of(own, turning, volume);
  REQUIRE(named.volumes[0].losses.size() == 1);
  REQUIRE(unnamed.volumes[0].losses.size() == 1);
  CHECK(std::abs(named.volumes[0].losses[0].end_s - corner_s) < 1e-9);
  CHECK(std::abs(unnamed.volumes[0].losses[0].end_s - corner_s) < 1e-3);
  CHECK(std::abs(unnamed.volumes[0].losses[0].begin_s - named.volumes[0].losses[0].begin_s) < 1e-6);
}

TEST_CASE("flights that share no time are named with their times") {
  EncounterTrack late = flying_straight({0, 0, 0}, {1, 0, 0});
  late.name = "late one";
  late.first_s = 500;
  late.last_s = 600;
  const Result<EncounterSummary> none = encounter_of(flying_straight({0, 0, 0}, {1, 0, 0}), late, {});
  REQUIRE_FALSE(none);
  CHECK(none.error().text().find("late one") != std::string::npos);
  CHECK(none.error().text().find("500") != std::string::npos);
  // One instant in common is enough.
  late.first_s = 200;
  const EncounterSummary instant = summary_of(flying_straight({0, 0, 0}, {1, 0, 0}), late, kCylinder, {200});
  CHECK(instant.rows.size() == 1);
  CHECK(instant.volumes[0].losses.empty());
}

TEST_CASE("the worst severity is at least that of every row, and at the nearest moment of a level passing") {
  std::vector<double> rows_s;
  for (int i = 0; i <= 200; ++i) rows_s.push_back(i);
  const EncounterSummary summary = summary_of(flying_straight({0, 0, -500}, {50, 0, 0}),
                                              flying_straight({6000, 100, -480}, {-50, 0, 0}), kCylinder, rows_s);
  for (const EncounterRow& row : summary.rows)
    CHECK(row.of_volumes[0].severity <= summary.volumes[0].worst_severity + 1e-9);
  // In a cylinder the horizontal share is least where the distance is; the miss is known from the entry on.
  CHECK(std::abs(*summary.volumes[0].worst_s - 60) < 1e-3);
  CHECK(summary.volumes[0].rows_lost == 11);
  CHECK(summary.rows[*summary.volumes[0].first_row_lost].time_s == 55);
  CHECK(summary.rows[*summary.nearest_row].time_s == 60);
}

TEST_CASE("recorded flights are checked: order of times, numbers") {
  SampledTrack track{.name = "N1", .samples = {{0, {}}, {1, {}}, {1, {}}}};
  REQUIRE_FALSE(check_track(track));
  CHECK(check_track(track).error().text().find("sample 2") != std::string::npos);
  track.samples[2].time_s = std::nan("");
  CHECK_FALSE(check_track(track));
  track.samples.pop_back();
  CHECK(check_track(track));
  track.samples[1].state.velocity_mps.x = std::nan("");
  CHECK(check_track(track));  // it is not read
  track.has_velocities = true;
  CHECK_FALSE(check_track(track));
  track.samples.clear();
  CHECK_FALSE(check_track(track));
}
