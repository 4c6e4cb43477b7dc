// SPDX-License-Identifier: MIT
#include "performance/risk.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace sigs::test {
namespace {

constexpr double kAtOnce = std::numeric_limits<double>::infinity();
const double kRadius_m = nmac_volume().dmod_m;
const double kHeight_m = nmac_volume().zthr_m;

// A sensor that sees everything within a range, at once, and nothing beyond.
SensorModel seeing_within(double range_m) {
  return {.detector = "made",
          .rate_hz = 20,
          .declare_hits = 1,
          .declare_window = 1,
          .range_m = {range_m},
          .quantiles = {9}};
}

// Straight level flights of one speed each; the manoeuvre climbs or descends at once at a rate.
RiskSettings straight(double sensor_m, double climb_mps) {
  RiskSettings settings{.sensor = seeing_within(sensor_m)};
  settings.encounters.own_speed_mps = {25, 25};
  settings.encounters.intruder_speed_mps = {50, 50};
  settings.encounters.miss_m = 400;
  settings.encounters.vertical_miss_m = 100;
  settings.encounters.lead_s = 30;
  settings.encounters.after_s = 8;
  settings.manoeuvre = {.kind = ManoeuvreKind::vertical_away,
                        .delay_s = 0,
                        .climb_mps = climb_mps,
                        .vertical_acceleration_mps2 = kAtOnce};
  settings.count = 20'000;
  settings.threads = 2;
  return settings;
}

RiskResult flown(const RiskSettings& settings) {
  const Result<RiskResult> result = simulated_risk(settings, {});
  REQUIRE(result);
  return *result;
}

// P(NMAC with the system) / P(NMAC without) of straight(), by summing over courses and misses. An intruder on a course
// comes at speed v and is seen at the slant range R; without the system there is an NMAC where the horizontal miss is
// within the radius and the vertical one within the height. From the moment on at which it is seen the vertical offset
// grows by climb times the time, which must take it beyond the height before the horizontal distance is the radius.
double expected_ratio(double sensor_m, double climb_mps) {
  double without = 0, with = 0;
  constexpr int kCourses = 720, kMisses = 200, kHeights = 100;
  for (int c = 0; c < kCourses; ++c) {
    const double course = 2 * std::numbers::pi * (c + 0.5) / kCourses;
    const double speed = std::hypot(50 * std::cos(course) - 25, 50 * std::sin(course));
    for (int m = 0; m < kMisses; ++m) {
      const double miss = kRadius_m * (m + 0.5) / kMisses;
      for (int h = 0; h < kHeights; ++h) {
        const double height = kHeight_m * (h + 0.5) / kHeights;
        without += speed;
        const double across = std::sqrt(std::max(0.0, sensor_m * sensor_m - height * height - miss * miss));
        const double seen_s = -std::min(across / speed, 30.0);  // before the closest approach
        const double enters_s = -std::sqrt(kRadius_m * kRadius_m - miss * miss) / speed;
        // Already within when it is seen, or not yet out of the way when it comes within.
        const double offset = height + climb_mps * std::max(0.0, enters_s - seen_s);
        with += seen_s >= enters_s || offset <= kHeight_m ? speed : 0;
      }
    }
  }
  return with / without;
}

}  // namespace

TEST_CASE("straight flights, a sensor that sees within R and an instant manoeuvre: the risk ratio is the sum's") {
  for (const auto& [sensor_m, climb_mps] : {std::pair(400.0, 5.0), std::pair(250.0, 4.0), std::pair(600.0, 1.5)}) {
    RiskSettings settings = straight(sensor_m, climb_mps);
    settings.count = 40'000;
    const RiskRatio ratio = risk_ratio(flown(settings).tallies[0].nmac);
    const double expected = expected_ratio(sensor_m, climb_mps);
    MESSAGE("R ", sensor_m, " m: ", ratio.ratio, " (", ratio.interval.low, " to ", ratio.interval.high, "), sum ",
            expected);
    CHECK(ratio.interval.low < expected);
    CHECK(expected < ratio.interval.high);
    CHECK(ratio.interval.high - ratio.interval.low < 0.1);
  }
}

TEST_CASE("importance sampling gives what plain sampling gives, more sharply") {
  RiskSettings settings = straight(300, 3);
  settings.encounters.miss_m = 1000;
  settings.count = 40'000;
  const RiskTally with = flown(settings).tallies[0];
  settings.encounters.importance_sampling = false;
  settings.seed = 99;
  const RiskTally plain = flown(settings).tallies[0];
  const RiskRatio a = risk_ratio(with.nmac), b = risk_ratio(plain.nmac);
  MESSAGE("importance ", a.ratio, " of ", a.interval.high - a.interval.low, ", plain ", b.ratio, " of ",
          b.interval.high - b.interval.low);
  CHECK(a.interval.low < b.interval.high);
  CHECK(b.interval.low < a.interval.high);
  CHECK(a.interval.high - a.interval.low < 0.8 * (b.interval.high - b.interval.low));
  // The probability of an NMAC without the system: the cross section's share of what is drawn from.
  const double share = kRadius_m / 1000 * kHeight_m / 100;
  for (const RiskTally& tally : {with, plain}) {
    const RiskRatio p = weighted_share(tally.nmac.without, tally.weight, tally);
    CHECK(p.ratio == doctest::Approx(share).epsilon(0.05));
  }
}

TEST_CASE("95 % intervals of the risk ratio hold the truth in 93 to 97 % of 1000 repetitions") {
  const double truth = risk_ratio(flown([] {
                                    RiskSettings many = straight(300, 4);
                                    many.count = 200'000;
                                    return many;
                                  }())
                                      .tallies[0]
                                      .nmac)
                           .ratio;
  int held = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    RiskSettings settings = straight(300, 4);
    settings.seed = 1000 + seed;
    settings.count = 500;
    const Interval interval = risk_ratio(flown(settings).tallies[0].nmac).interval;
    held += interval.low <= truth && truth <= interval.high ? 1 : 0;
  }
  MESSAGE("held ", held);
  CHECK(held > 930);
  CHECK(held < 970);
}

TEST_CASE("the result does not depend on threads, and shards merge to the same bits") {
  RiskSettings settings = straight(400, 4);
  settings.count = 5'500;  // the last batch is half full
  const RiskResult whole = flown(settings);
  settings.threads = 1;
  CHECK(risk_json(settings, flown(settings)) == risk_json(settings, whole));
  std::vector<RiskShard> shards;
  for (int i = 1; i <= 3; ++i) {
    settings.shard = i;
    settings.shards = 3;
    const Json json = Json::parse(json_text(risk_json(settings, flown(settings))));
    const Result<RiskShard> shard = risk_shard_of(json, "part");
    REQUIRE(shard);
    shards.push_back(*shard);
  }
  std::swap(shards[0], shards[2]);
  const Result<Json> merged = merged_risk_json(shards, {"c", "b", "a"});
  REQUIRE(merged);
  settings.shard = settings.shards = 1;
  CHECK(json_text(*merged) == json_text(risk_json(settings, whole)));
  shards.pop_back();
  const Result<Json> less = merged_risk_json(shards, {"c", "b"});
  REQUIRE_FALSE(less);
  CHECK(less.error().what.find("missing") != std::string::npos);
  shards[1].settings["seed"] = 77;
  CHECK_FALSE(merged_risk_json(shards, {"c", "b"}));
}

TEST_CASE("a blind sensor changes nothing, and no manoeuvre neither") {
  RiskSettings settings = straight(0.001, 5);
  settings.count = 3000;
  const RiskTally blind = flown(settings).tallies[0];
  CHECK(risk_ratio(blind.nmac).ratio == 1);
  CHECK(blind.declared == 0);
  CHECK(blind.unnecessary == 0);
  settings = straight(1000, 5);
  settings.count = 3000;
  settings.manoeuvre.kind = ManoeuvreKind::none;
  const RiskTally none = flown(settings).tallies[0];
  CHECK(risk_ratio(none.nmac).ratio == 1);
  CHECK(none.declared > 0);
  CHECK(none.manoeuvred == 0);
}

TEST_CASE("a field of view that looks away sees nothing; one that looks ahead not what comes from behind") {
  RiskSettings settings = straight(2000, 20);
  settings.count = 4000;
  settings.sensor.field_of_view = {.left_rad = -0.6, .right_rad = 0.6, .down_rad = -0.5, .up_rad = 0.5};
  const RiskResult result = flown(settings);
  CHECK(risk_ratio(result.tallies[1].nmac).ratio < 0.05);  // head-on
  CHECK(risk_ratio(result.tallies[3].nmac).ratio > 0.9);   // equal courses: the faster intruder comes from behind
}

TEST_CASE("what is left of the NMACs is told by what failed, and adds up") {
  RiskSettings settings = straight(300, 4);
  settings.count = 4000;
  settings.sensor.field_of_view = {.left_rad = -0.6, .right_rad = 0.6, .down_rad = -0.5, .up_rad = 0.5};
  settings.alert_rate_radps = 0.1;
  const RiskTally tally = flown(settings).tallies[0];
  CHECK(tally.out_of_view > 0);
  CHECK(tally.insufficient > 0);
  CHECK(tally.out_of_view + tally.undeclared + tally.waiting + tally.insufficient + tally.induced ==
        doctest::Approx(tally.nmac.with).epsilon(1e-9));
  // All around and seen at once: nothing is out of view or undeclared.
  settings.sensor = seeing_within(2000);
  const RiskTally seen = flown(settings).tallies[0];
  CHECK(seen.out_of_view == 0);
  CHECK(seen.undeclared == 0);
}

TEST_CASE("what recedes leads to no manoeuvre") {
  const auto line = [](double from_m, double speed_mps) {
    SampledTrack track{.name = "a", .samples = {}};
    for (const double t : {0.0, 40.0}) track.samples.push_back({t, {.position_m = {from_m + speed_mps * t, 0, -100}}});
    return track_of(track);
  };
  RiskSettings settings = straight(5000, 5);
  settings.count = 1;
  settings.encounters.pairs = {{.name = "away", .own = line(0, 20), .intruder = line(200, 60)}};
  const RiskTally tally = flown(settings).tallies[0];
  CHECK(tally.declared == 1);
  CHECK(tally.manoeuvred == 0);
}

TEST_CASE("courses and sides are told apart, and make up all encounters") {
  RiskSettings settings = straight(500, 4);
  settings.count = 4000;
  const RiskResult result = flown(settings);
  CHECK(result.tallies[1].encounters + result.tallies[2].encounters + result.tallies[3].encounters == 4000);
  CHECK(result.tallies[4].encounters + result.tallies[5].encounters == 4000);
  CHECK(result.tallies[1].encounters == doctest::Approx(1000).epsilon(0.1));  // 90 of 360 degrees
}

TEST_CASE("it stops when the interval is as narrow as asked, and says so where it is not") {
  RiskSettings settings = straight(300, 4);
  settings.count = 100'000;
  settings.until = 0.05;
  const RiskResult result = flown(settings);
  const RiskRatio ratio = risk_ratio(result.tallies[0].nmac);
  CHECK(result.is_precise);
  CHECK(result.tallies[0].encounters < 100'000);
  CHECK((ratio.interval.high - ratio.interval.low) / 2 <= 0.05 * ratio.ratio);
  settings.count = 1000;
  CHECK_FALSE(flown(settings).is_precise);
}

TEST_CASE("ratios at the edges") {
  CHECK(std::isnan(risk_ratio({}).ratio));
  const RiskRatio none = risk_ratio({.without = 100, .with = 0, .without_squares = 100});
  CHECK(none.ratio == 0);
  CHECK(none.interval.low == 0);
  CHECK(none.interval.high == doctest::Approx(0.03));  // three of a hundred
  // All the same encounters have both: no doubt about 1.
  const RiskRatio same =
      risk_ratio({.without = 50, .with = 50, .without_squares = 50, .with_squares = 50, .both_squares = 50});
  CHECK(same.interval.low == 1);
  CHECK(same.interval.high == 1);
}

TEST_CASE("speeds of zero and equal speeds are flown without a stop") {
  for (const double speed : {0.0, 25.0}) {
    RiskSettings settings = straight(500, 4);
    settings.count = 500;
    settings.encounters.intruder_speed_mps = {speed, speed};
    settings.encounters.own_speed_mps = {speed, speed};
    for (const ManoeuvreKind kind : {ManoeuvreKind::turn_away, ManoeuvreKind::slow_down, ManoeuvreKind::speed_up}) {
      settings.manoeuvre.kind = kind;
      const RiskTally tally = flown(settings).tallies[0];
      CHECK(std::isfinite(tally.weight));
      CHECK(std::isfinite(tally.nmac.with));
    }
  }
  RiskSettings bad = straight(500, 4);
  bad.encounters.own_speed_mps = {30, 20};
  CHECK_FALSE(simulated_risk(bad, {}));
}

TEST_CASE("recorded pairs are flown as they are, and images declare where they did") {
  // Head-on at one height, 100 m/s, at the same place after 30 s.
  const auto line = [](double from_m, double speed_mps) {
    SampledTrack track{.name = "a", .samples = {}};
    for (const double t : {0.0, 40.0}) track.samples.push_back({t, {.position_m = {from_m + speed_mps * t, 0, -100}}});
    return track_of(track);
  };
  RiskPair pair{.name = "head-on", .own = line(0, 40), .intruder = line(3000, -60)};
  RiskSettings settings = straight(1, 5);
  settings.count = 1;
  const auto with = [&](std::optional<double> declared_s) {
    pair.declared_s = declared_s;
    pair.is_from_images = true;
    settings.encounters.pairs = {pair};
    return flown(settings).tallies[0];
  };
  CHECK(with(std::nullopt).nmac.with == 1);
  // 30.48 m at 5 m/s take 6.1 s; within the radius it is 1.5 s before the meeting: 22.4 s is early enough.
  CHECK(with(22.2).nmac.with == 0);
  CHECK(with(22.6).nmac.with == 1);
  CHECK(with(22.2).nmac.without == 1);
  CHECK(with(22.2).declared == 1);
  // What was declared waits as the sensor's tracks do: until it is within 700 m, 23 s; that is too late.
  settings.alert_range_m = 1000;
  CHECK(with(5).nmac.with == 0);
  settings.alert_range_m = 700;
  CHECK(with(5).nmac.with == 1);
  CHECK(with(5).manoeuvred == 1);
  settings.alert_range_m = kAtOnce;
  pair.is_from_images = false;
  settings.sensor = seeing_within(1000);
  settings.encounters.pairs = {pair};
  settings.count = 3;
  const RiskTally drawn = flown(settings).tallies[0];
  CHECK(drawn.nmac.without == 3);
  CHECK(drawn.nmac.with == 0);  // 1000 m are 10 s
}

TEST_CASE("a table of rules decides by the first row that holds") {
  const Result<Logic> logic = logic_table(
      "bearing_min_deg,bearing_max_deg,rate_max_deg_s,manoeuvre\n# "
      "remark\n-180,0,,turn-right\n0,30,1,turn-left\n,,,climb\n",
      "rules.csv");
  REQUIRE(logic);
  const auto decided = [&](double bearing, double rate) {
    return *(*logic)({.bearing_rad = bearing, .bearing_rate_radps = rate});
  };
  CHECK(decided(-0.5, 1) == ManoeuvreKind::turn_right);
  CHECK(decided(0.2, 0) == ManoeuvreKind::turn_left);
  CHECK(decided(0.2, 0.1) == ManoeuvreKind::climb);
  CHECK(decided(2, 0) == ManoeuvreKind::climb);
  const auto error = [](const char* text) {
    const Result<Logic> read = logic_table(text, "rules.csv");
    REQUIRE_FALSE(read);
    return read.error().where + ": " + read.error().what;
  };
  CHECK(error("").find("rules.csv") == 0);
  CHECK(error("bearing,manoeuvre\n").find("line 1") != std::string::npos);
  CHECK(error("bearing_min_deg\n3\n").find("no column manoeuvre") != std::string::npos);
  CHECK(error("manoeuvre\njump\n").find("line 2") != std::string::npos);
  CHECK(error("bearing_min_deg,manoeuvre\nx,climb\n").find("no number") != std::string::npos);
  CHECK(error("bearing_min_deg,manoeuvre\nclimb\n").find("1 values") != std::string::npos);
}

TEST_CASE("a decision that fails ends the run with its error") {
  RiskSettings settings = straight(500, 4);
  settings.count = 3000;
  const Result<RiskResult> result =
      simulated_risk(settings, [](const ThreatView&) -> Result<ManoeuvreKind> { return fail("logic", "gave up"); });
  REQUIRE_FALSE(result);
  CHECK(result.error().what == "gave up");
}

}  // namespace sigs::test
