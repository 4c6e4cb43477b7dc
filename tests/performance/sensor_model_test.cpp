// SPDX-License-Identifier: MIT
#include "performance/sensor_model.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "performance/made_encounters.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

Performance made(const MadeSensor& sensor, int count, std::uint64_t seed = 5) {
  Random random(seed);
  return performance_of({.detector = "made", .encounters = made_encounters(sensor, count, random), .rate_hz = 10}, {});
}

double probability_at(const SensorModel& model, double range_m, HorizonSide side = HorizonSide::above) {
  return model.probability(range_m, side, 0);
}

}  // namespace

TEST_CASE("the fit finds the sensor that made the frames") {
  const MadeSensor sensor{.reach_m = 800, .slope_m = 200, .encounter_share = 0.4, .below_shift = -1};
  const Performance performance = made(sensor, 300);
  const Result<SensorFit> fit = fitted_sensor_model(performance, std::nullopt);
  REQUIRE(fit);
  const SensorModel& model = fit->model;
  CHECK(fit->chosen.find("horizon") != std::string::npos);
  for (const double range_m : {300.0, 600.0, 800.0, 1000.0, 1300.0}) {
    CHECK(probability_at(model, range_m) ==
          doctest::Approx(normal_share_below((800 - range_m) / 200)).epsilon(0.05).scale(1));
    CHECK(probability_at(model, range_m, HorizonSide::below) ==
          doctest::Approx(normal_share_below((600 - range_m) / 200)).epsilon(0.05).scale(1));
  }
  CHECK(model.below_horizon == doctest::Approx(-1).epsilon(0.2));
  // Shares of the noise come in steps of a twentieth.
  CHECK(model.encounter_share + model.fading_share == doctest::Approx(0.4).epsilon(0.26));
  CHECK(model.frames == performance.detected.frames);
  CHECK_FALSE(model.false_tracks_per_hour);  // no footage was looked at
}

TEST_CASE("the model declares where the sensor declared, on encounters that it was not fitted to") {
  const SensorModelCheck check = checked_sensor_model(made({.encounter_share = 0.4}, 150));
  MESSAGE("distance ", check.distance.distance, ", p ", check.distance.p_value);
  CHECK(check.images_m.size() == 150);
  CHECK(check.distance.distance < 0.12);  // of 150: 5 % of samples of one distribution are farther apart than 0.11
  CHECK(check.declared_model == doctest::Approx(check.declared_images).epsilon(0.05));
}

TEST_CASE("a model of frames alone would declare too early: the correlation is what makes it right") {
  // Noise that an encounter has throughout: the same probability in each frame, but all or nothing in each encounter.
  const Performance performance = made({.reach_m = 500, .slope_m = 150, .encounter_share = 0.9}, 150);
  const Result<SensorFit> fit = fitted_sensor_model(performance, std::nullopt);
  REQUIRE(fit);
  CHECK(fit->model.encounter_share + fit->model.fading_share > 0.75);
  CHECK(checked_sensor_model(performance).distance.distance < 0.15);
}

TEST_CASE("probability by range: nearer than the first place as there, beyond the last none") {
  SensorModel model{.range_m = {100, 1000}, .quantiles = {1, -1}, .below_horizon = -0.5};
  CHECK(model.quantile_at(0, HorizonSide::above, 0) == 1);
  CHECK(model.quantile_at(1e-9, HorizonSide::above, 0) == 1);
  CHECK(model.quantile_at(std::sqrt(1e5), HorizonSide::above, 0) == doctest::Approx(0).epsilon(1e-12).scale(1));
  CHECK(model.quantile_at(1000, HorizonSide::below, 0) == -1.5);
  CHECK(model.probability(1000.001, HorizonSide::above, 0) == 0);
  CHECK(model.probability(1e7, HorizonSide::above, 0) == 0);
  CHECK(model.probability(std::nan(""), HorizonSide::above, 0) == 0);
  CHECK(model.probability(500, HorizonSide::unknown, std::nan("")) == model.probability(500, HorizonSide::above, 0));
}

TEST_CASE("drawn noise has the shares and the time that the model states") {
  const SensorModel model{
      .range_m = {1000}, .quantiles = {0}, .encounter_share = 0.3, .fading_share = 0.5, .correlation_s = 2};
  int all = 0, both = 0;
  constexpr int kCount = 40'000;
  for (int i = 0; i < kCount; ++i) {
    Random random(1, static_cast<std::uint64_t>(i));
    SensorDraw draw(model, random);
    const bool first = draw.detects(0, 0, random);
    const bool second = draw.detects(0, 2, random);
    all += first ? 1 : 0;
    both += first && second ? 1 : 0;
  }
  CHECK(all / double(kCount) == doctest::Approx(0.5).epsilon(0.02));
  CHECK(both / double(kCount) == doctest::Approx(both_below(0, 0, 0.3 + 0.5 * std::exp(-1.0))).epsilon(0.03));
}

TEST_CASE("a model comes back from its file") {
  const TemporaryFolder folder;
  Result<SensorFit> fit = fitted_sensor_model(made({.below_shift = -1}, 40), FieldOfView{-0.5, 0.5, -0.4, 0.3});
  REQUIRE(fit);
  fit->model.range_sd = 0.2;
  fit->model.false_tracks_per_hour = 3.5;
  const std::filesystem::path file = folder.path() / "sensor.json";
  std::ofstream(file) << sensor_model_json(fit->model);
  const Result<SensorModel> read = read_sensor_model(file);
  REQUIRE(read);
  for (double range_m = 20; range_m < 1700; range_m *= 1.1)
    CHECK(probability_at(*read, range_m, HorizonSide::below) ==
          doctest::Approx(probability_at(fit->model, range_m, HorizonSide::below)).epsilon(1e-4).scale(1));
  CHECK(read->encounter_share == fit->model.encounter_share);
  CHECK(*read->range_sd == 0.2);
  CHECK(*read->false_tracks_per_hour == 3.5);
  CHECK(read->field_of_view.left_rad == doctest::Approx(-0.5).epsilon(1e-5));
  CHECK(read->is_field_known);
}

TEST_CASE("files that are no model are refused with the member's name") {
  const TemporaryFolder folder;
  const auto error_of = [&](const std::string& text) {
    const std::filesystem::path file = folder.path() / "sensor.json";
    std::ofstream(file, std::ios::trunc) << text;
    const Result<SensorModel> read = read_sensor_model(file);
    REQUIRE_FALSE(read);
    return read.error().where + ": " + read.error().what;
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const std::string head = R"({"sigs_sensor_model": 1, "frame_rate_hz": 10, )";
  CHECK(has(error_of("{}"), "is no sensor model"));
  CHECK(has(error_of("nonsense"), "sensor.json"));
  CHECK(has(error_of(R"({"sigs_sensor_model": 1})"), "frame_rate_hz"));
  CHECK(has(error_of(head + R"("latencyy_s": 1, "detection": {"range_m": [100], "probability": [1]}})"), "latencyy_s"));
  CHECK(
      has(error_of(head + R"("detection": {"range_m": [100], "probability": [1], "shift": {"below": 1}}})"), "below"));
  CHECK(has(error_of(head + R"("detection": {"range_m": [100, 100], "probability": [1, 0]}})"), "range_m"));
  CHECK(has(error_of(head + R"("detection": {"range_m": [100], "probability": [1, 0]}})"), "probability"));
  CHECK(has(error_of(head + R"("detection": {"range_m": [], "probability": []}})"), "range_m"));
  CHECK(has(error_of(head + R"("detection": {"range_m": [100], "probability": [1.5]}})"), "probability"));
  CHECK(has(
      error_of(head + R"("declare": {"hits": 6, "window": 5}, "detection": {"range_m": [100], "probability": [1]}})"),
      "hits"));
  CHECK(has(
      error_of(
          head +
          R"("correlation": {"encounter_share": 0.7, "fading_share": 0.7}, "detection": {"range_m": [100], "probability": [1]}})"),
      "fading_share"));
}

TEST_CASE("a model needs two encounters") {
  CHECK_FALSE(fitted_sensor_model(made({}, 1), std::nullopt));
  CHECK(fitted_sensor_model(made({}, 2), std::nullopt));
}

}  // namespace sigs::test
