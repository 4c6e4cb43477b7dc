// SPDX-License-Identifier: MIT
#include "performance/performance.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "performance/made_encounters.h"
#include "performance/performance_report.h"

namespace sigs::test {
namespace {

RangeCurve detected_curve(const std::vector<ObservedEncounter>& encounters, int draws = 400) {
  return range_curve(
      encounters, [](const SeenFrame& frame) { return frame.is_detected; },
      [](const ObservedEncounter&, const SeenFrame&) { return true; }, draws);
}

Performance made_performance(const MadeSensor& sensor, int count, std::uint64_t seed = 5, int min_encounters = 10) {
  Random random(seed);
  return performance_of({.detector = "made", .encounters = made_encounters(sensor, count, random), .rate_hz = 10}, {},
                        min_encounters);
}

const Condition& condition(const Performance& performance, const std::string& by, const std::string& name) {
  const auto found =
      std::ranges::find_if(performance.conditions, [&](const Condition& c) { return c.by == by && c.name == name; });
  REQUIRE(found != performance.conditions.end());
  return *found;
}

}  // namespace

TEST_CASE("95 % intervals of ranges hold the truth in 93 to 97 % of 1000 repetitions") {
  const MadeSensor sensor{.reach_m = 700, .slope_m = 120, .encounter_share = 0.6};
  int held[3] = {0, 0, 0};
  constexpr int kRepetitions = 1000;
  for (int i = 0; i < kRepetitions; ++i) {
    Random random(19, static_cast<std::uint64_t>(i));
    const RangeCurve curve = detected_curve(made_encounters(sensor, 60, random), 300);
    for (std::size_t k = 0; k < 3; ++k) {
      const double truth_m = sensor.range_at(curve.ranges[k].probability);
      held[k] += curve.ranges[k].interval.low <= truth_m && truth_m <= curve.ranges[k].interval.high ? 1 : 0;
    }
  }
  for (const int count : held) {
    MESSAGE("held: ", count);
    CHECK(count > 930);
    CHECK(count < 970);
  }
}

TEST_CASE("ranges are those of a sensor that is known") {
  const MadeSensor sensor{.reach_m = 800, .slope_m = 100, .encounter_share = 0.1};
  const RangeCurve curve = made_performance(sensor, 600).detected;
  CHECK(curve.encounters == 600);
  // Half a percent: some 20,000 frames lie within a slope of each range.
  for (const RangeAt& range : curve.ranges)
    CHECK(range.range_m == doctest::Approx(sensor.range_at(range.probability)).epsilon(0.02));
  for (const RangeBin& bin : curve.bins)
    if (bin.low_m == 500)  // the mean over the bin of Phi((800 - r) / 100)
      CHECK(double(bin.detected) / bin.frames == doctest::Approx(0.95735).epsilon(0.01));
}

TEST_CASE("what is always seen is seen beyond the farthest frame, what never is nowhere") {
  const Performance always = made_performance({.reach_m = 1e6, .slope_m = 1}, 20);
  CHECK(std::isinf(always.detected.ranges[2].range_m));
  CHECK(range_text(always.detected.ranges[2], always.detected.farthest_m).starts_with("over 1"));
  const Performance never = made_performance({.reach_m = -1e6, .slope_m = 1}, 20);
  CHECK(never.detected.ranges[0].range_m == 0);
  CHECK(never.encounters_declared == 0);
  CHECK(never.declaration_range_m.count == 0);
  CHECK(range_text(never.detected.ranges[0], 1600).starts_with("never"));
  // Twenty encounters that all failed do not exclude a twentieth part of successes (Jeffreys' interval ends at 0.12).
  CHECK(never.detected.band[30].high > 0.02);
  CHECK(never.detected.band[30].high < 0.3);
}

TEST_CASE("a sensor that is worse below the horizon is reported so") {
  const Performance performance = made_performance({.below_shift = -1.5}, 100);
  const Condition& above = condition(performance, "horizon", "above");
  const Condition& below = condition(performance, "horizon", "below");
  CHECK(above.detected.encounters == 50);
  CHECK(above.detected.ranges[0].range_m == doctest::Approx(800).epsilon(0.08));
  CHECK(below.detected.ranges[0].range_m == doctest::Approx(500).epsilon(0.12));  // 1.5 slopes nearer
  CHECK(below.detected.interval.high < above.detected.interval.low);
  CHECK_FALSE(below.is_too_few);
}

TEST_CASE("conditions of few encounters say so, and tags that tell nothing are no conditions") {
  Random random(2);
  std::vector<ObservedEncounter> encounters = made_encounters({}, 12, random);
  for (std::size_t i = 0; i < encounters.size(); ++i)
    encounters[i].tags = {{"sky", i < 3 ? "fog" : "clear"}, {"dataset", "mine"}};
  const Performance performance =
      performance_of({.detector = "made", .encounters = std::move(encounters), .rate_hz = 10}, {});
  CHECK(condition(performance, "sky", "fog").is_too_few);
  CHECK(condition(performance, "sky", "fog").detected.encounters == 3);
  CHECK(condition(performance, "horizon", "above").is_too_few);
  CHECK_FALSE(condition(performance, "sky", "clear").is_too_few == (9 >= 10));
  for (const Condition& one : performance.conditions) CHECK(one.by != "dataset");
}

TEST_CASE("no encounters give no ranges, and false tracks all the same") {
  Observations observations{.detector = "made", .encounters = {}, .rate_hz = 10};
  observations.empty = {.clips = 1, .hours = 2, .declared = 0, .boxes = 0};
  observations.all = observations.empty;
  const Performance performance = performance_of(std::move(observations), {});
  CHECK(std::isnan(performance.detected.ranges[0].range_m));
  CHECK(performance.false_per_hour_empty.high == doctest::Approx(1.4978661).epsilon(1e-6));  // 3.0 in two hours
  PerformanceReport report{.performance = performance, .needed = needed_ranges(performance, {}, {})};
  CHECK(performance_text(report).find("No intruder is ever visible") != std::string::npos);
}

TEST_CASE("the range needed is radius and way until the manoeuvre is flown") {
  const Performance performance = made_performance({.reach_m = 1000, .slope_m = 60, .encounter_share = 0}, 40);
  const std::vector<NeededRange> needed = needed_ranges(performance, {.own_mps = 25, .intruder_mps = 45}, {});
  REQUIRE(needed.size() == 6);
  CHECK(needed[0].needed_m == doctest::Approx(609.6 + 70 * 10).epsilon(1e-12));
  CHECK(needed[1].needed_m == doctest::Approx(152.4 + 70 * 10).epsilon(1e-12));
  CHECK(needed[2].closing_speed_mps == doctest::Approx(std::hypot(25, 45)).epsilon(1e-12));
  CHECK(needed[4].needed_m == 0);  // the slower own aircraft never overtakes
  // The frames have no aspect, so nothing is known of head-on encounters.
  CHECK(needed[0].encounters == 0);
  CHECK_FALSE(needed[0].suffices);
  CHECK_FALSE(needed[4].suffices);
}

TEST_CASE("a range that was not reached does not suffice, and one that may be is not known to") {
  Random random(4);
  std::vector<ObservedEncounter> encounters =
      made_encounters({.reach_m = 1000, .slope_m = 30, .encounter_share = 0}, 40, random);
  for (ObservedEncounter& encounter : encounters)
    for (SeenFrame& frame : encounter.frames) frame.aspect_rad = 0.1;
  const Performance performance = performance_of({.detector = "made", .encounters = encounters, .rate_hz = 10}, {});
  const std::vector<NeededRange> needed = needed_ranges(performance, {}, {});
  CHECK(needed[0].reached.range_m == doctest::Approx(950).epsilon(0.05));
  CHECK(*needed[0].suffices == false);  // 1310 m
  CHECK(*needed[1].suffices == true);   // 852 m
  // Seen always, but never farther than 1600 m: whether 3000 m would be reached is not known.
  for (ObservedEncounter& encounter : encounters)
    for (SeenFrame& frame : encounter.frames) frame.is_declared = true;
  const Performance perfect = performance_of({.detector = "made", .encounters = encounters, .rate_hz = 10}, {});
  const std::vector<NeededRange> far = needed_ranges(perfect, {.own_mps = 100, .intruder_mps = 140}, {});
  CHECK_FALSE(far[0].suffices);
}

TEST_CASE("spreads leave out what is not known") {
  const Spread spread = spread_of({3, std::nan(""), 1, 2});
  CHECK(spread.count == 3);
  CHECK(spread.median == 2);
  CHECK(spread.greatest == 3);
  CHECK(std::isnan(spread_of({}).median));
}

}  // namespace sigs::test
