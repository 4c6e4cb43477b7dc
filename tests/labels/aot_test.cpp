// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace labels;

namespace {

nlohmann::json written_aot(const LabelSequence& clip, const std::vector<FrameTruth>& frames) {
  const TemporaryFolder folder;
  write_labels("aot", folder / "l.json", clip, frames);
  nlohmann::json json = nlohmann::json::parse(text_of(folder / "l.json"), nullptr, false);
  REQUIRE_FALSE(json.is_discarded());
  return json;
}

nlohmann::json entities_of(const LabelSequence& clip, const std::vector<FrameTruth>& frames) {
  return written_aot(clip, frames)["samples"][clip.name]["entities"];
}

}  // namespace

TEST_CASE("an entity of the airborne data has every field of its specification") {
  IntruderTruth truth = visible_intruder(0, {639, 0, 1, 480});
  truth.position_m = {3000, -4000, 12000};
  const nlohmann::json entities = entities_of(synthetic_sequence(100, 100, {"airplane"}), {frame_of(100, {truth})});
  REQUIRE(entities.size() == 1);
  const nlohmann::json expected = {{"time", 4'000'000'000},
                                   {"blob", {{"frame", 100}, {"range_distance_m", 13000}}},
                                   {"id", "Airplane1"},
                                   {"bb", {639, 0, 1, 480}},
                                   {"labels", {{"is_above_horizon", 1}}},
                                   {"flight_id", "clip"},
                                   {"img_name", "clip/frame_000100.png"}};
  CHECK(entities[0] == expected);
}

TEST_CASE("the airborne data's flight has frame rate and size of the footage") {
  LabelSequence clip = synthetic_sequence(10, 609, {"airplane"});
  clip.footage.frame_rate_num = 30000;
  clip.footage.frame_rate_den = 1001;
  const nlohmann::json json = written_aot(clip, {});
  CHECK(json["metadata"].is_object());
  const nlohmann::json flight = json["samples"]["clip"]["metadata"];
  CHECK(flight["resolution"]["width"] == 640);
  CHECK(flight["resolution"]["height"] == 480);
  CHECK(flight["number_of_frames"] == 600);
  CHECK(flight["fps"].get<double>() == doctest::Approx(29.97003).epsilon(1e-7));
  CHECK(flight["duration"].get<double>() == doctest::Approx(20020));  // ms: 600 * 1001 / 30
  CHECK(json["samples"]["clip"]["entities"].empty());
}

TEST_CASE("sides of the horizon are 1, 0 and -1") {
  FrameTruth frame = frame_of(
      0, {visible_intruder(0, {1, 1, 2, 2}), visible_intruder(1, {5, 5, 2, 2}), visible_intruder(2, {9, 9, 2, 2})});
  frame.intruders[0].horizon = HorizonSide::below;
  frame.intruders[1].horizon = HorizonSide::on;
  const nlohmann::json entities = entities_of(synthetic_sequence(0, 0, {"airplane", "airplane", "drone"}), {frame});
  REQUIRE(entities.size() == 3);
  CHECK(entities[0]["labels"]["is_above_horizon"] == -1);
  CHECK(entities[1]["labels"]["is_above_horizon"] == 0);
  CHECK(entities[2]["labels"]["is_above_horizon"] == 1);
  CHECK(entities[1]["id"] == "Airplane2");
  CHECK(entities[2]["id"] == "Drone3");
}

TEST_CASE("a frame without objects is in the airborne data without one") {
  const nlohmann::json entities = entities_of(
      synthetic_sequence(0, 2, {"airplane"}),
      {frame_of(0, {invisible_intruder(0)}), frame_of(1, {visible_intruder(0, {1, 1, 2, 2})}), frame_of(2, {})});
  REQUIRE(entities.size() == 3);
  for (const std::size_t i : {0U, 2U}) {
    CHECK(entities[i]["blob"] == nlohmann::json{{"frame", i}});
    CHECK_FALSE(entities[i].contains("id"));
    CHECK_FALSE(entities[i].contains("bb"));
    CHECK(entities[i]["labels"].empty());
    CHECK(entities[i]["img_name"] == "clip/" + image_name(static_cast<int>(i)));
  }
  CHECK(entities[1].contains("bb"));
}

TEST_CASE("the airborne data leaves out objects below the thresholds") {
  LabelSequence clip = synthetic_sequence(0, 1, {"airplane"});
  clip.thresholds.min_visible_fraction = 0.5;
  IntruderTruth hidden = visible_intruder(0, {1, 1, 2, 2});
  hidden.visible_fraction = 0.4;
  const nlohmann::json entities =
      entities_of(clip, {frame_of(0, {hidden}), frame_of(1, {visible_intruder(0, {1, 1, 2, 2})})});
  REQUIRE(entities.size() == 2);
  CHECK_FALSE(entities[0].contains("bb"));
  CHECK(entities[1].contains("bb"));
}

TEST_CASE("objects of one flight never share an id, whatever their categories are called") {
  std::vector<std::string> categories{"a", "a1", "1", "A", "light aircraft", "\xC3\xBC"};
  for (int i = 0; i < 9; ++i) categories.push_back("a" + std::to_string(i));
  categories[11] = "a";  // the twelfth: "A" and 12 beside "A1" and 2
  FrameTruth frame = frame_of(0, {});
  for (std::size_t i = 0; i < categories.size(); ++i)
    frame.intruders.push_back(visible_intruder(static_cast<int>(i), {1, 1, 2, 2}));
  std::set<std::string> ids;
  for (const nlohmann::json& entity : entities_of(synthetic_sequence(0, 0, categories), {frame}))
    ids.insert(entity["id"]);
  CHECK(ids.size() == categories.size());
  CHECK(ids.count("Light aircraft5") == 1);
}

TEST_CASE("odd names and far intruders are plain JSON") {
  LabelSequence clip = synthetic_sequence(0, 0, {"q\"uote\\ \n"});
  clip.name = "a \"b\" \xC3\xBC <&>";
  clip.images = clip.name;
  IntruderTruth truth = visible_intruder(0, {1, 1, 2, 2});
  truth.position_m = {1e7, 0, 0};
  const nlohmann::json entity = entities_of(clip, {frame_of(0, {truth})}).at(0);
  CHECK(entity["blob"]["range_distance_m"] == 1e7);
  CHECK(entity["flight_id"] == clip.name);
  CHECK(entity["id"] == "Q\"uote\\1");
  clip.name = clip.images = "bad \xFF";
  CHECK(written_aot(clip, {frame_of(0, {truth})})["samples"].contains("bad \xEF\xBF\xBD"));
}

TEST_CASE("a distractor has a box and no range, as what is no planned encounter in the original") {
  IntruderTruth bird = visible_intruder(0, {1, 1, 2, 2});
  bird.is_distractor = true;
  const nlohmann::json entity = entities_of(synthetic_sequence(0, 0, {"bird"}), {frame_of(0, {bird})}).at(0);
  CHECK(entity["id"] == "Bird1");
  CHECK(entity["bb"] == nlohmann::json{1, 1, 2, 2});
  CHECK_FALSE(entity["blob"].contains("range_distance_m"));
}

TEST_CASE("the airborne data does not depend on the locale") {
  const TemporaryFolder folder;
  IntruderTruth truth = visible_intruder(0, {1, 1, 2, 2});
  truth.position_m = {1234.5, 0, 0};
  const LabelSequence clip = synthetic_sequence(2000, 2000, {"airplane"});
  write_labels("aot", folder / "a", clip, {frame_of(2000, {truth})});
  const CommaLocale comma;
  write_labels("aot", folder / "b", clip, {frame_of(2000, {truth})});
  CHECK(text_of(folder / "a") == text_of(folder / "b"));
  CHECK(text_of(folder / "a").find("1234.5,") == std::string::npos);
  CHECK(text_of(folder / "a").find("1234.5") != std::string::npos);
}

}  // namespace sigs::test
