// SPDX-License-Identifier: MIT
#include "dataset/recipe.h"

#include <doctest/doctest.h>

#include <fstream>
#include <functional>

#include "dataset/recipe_folder.h"

using namespace sigs;
using namespace sigs::test;
namespace {

nlohmann::ordered_json changed(const std::function<void(nlohmann::ordered_json&)>& change) {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  change(json);
  return json;
}

// The sample recipe with one thing put in, by its JSON pointer.
std::string error_with(const std::string& pointer, const nlohmann::ordered_json& value) {
  return RecipeFolder().error(
      changed([&](nlohmann::ordered_json& json) { json[nlohmann::ordered_json::json_pointer(pointer)] = value; }));
}

Recipe read_with(const std::string& pointer, const nlohmann::ordered_json& value) {
  const RecipeFolder folder;
  const Result<ReadRecipe> read = folder.read(
      changed([&](nlohmann::ordered_json& json) { json[nlohmann::ordered_json::json_pointer(pointer)] = value; }));
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->warnings.empty());
  return read->recipe;
}

Quantity quantity_with(const nlohmann::ordered_json& value) {
  return read_with("/videos/0/flights/0", {{"kind", "left_right"}, {"distance_m", value}})
      .groups[0]
      .flights[0]
      .quantities.at("distance_m");
}

std::string quantity_error(const nlohmann::ordered_json& value) {
  return error_with("/videos/0/flights/0", {{"kind", "left_right"}, {"distance_m", value}});
}

}  // namespace

TEST_CASE("a small recipe is read with all its defaults") {
  const RecipeFolder folder;
  const Result<ReadRecipe> read = folder.read(RecipeFolder::recipe());
  REQUIRE(read);
  const Recipe& recipe = read->recipe;
  CHECK(read->warnings.empty());
  CHECK(recipe.name == "set");
  CHECK(recipe.seed == 0);
  CHECK(recipe.splits.empty());
  CHECK(recipe.backgrounds[0].camera.speed_mps == 22);
  CHECK(recipe.backgrounds[0].camera.position_m == glm::dvec3(0, 0, -150));
  CHECK(recipe.aircraft[0].category == "airplane");
  CHECK(!recipe.aircraft[0].speed_limits_mps);
  CHECK(recipe.groups[0].name == "{background}-{aircraft}-{flight}");
  CHECK(recipe.groups[0].backgrounds == std::vector<std::string>{"day"});
  CHECK(recipe.groups[0].aircraft == std::vector<std::string>{"jet"});
  CHECK(recipe.groups[0].flights[0].name == "left_right");
  CHECK(recipe.groups[0].count == 1);
  CHECK(!recipe.groups[0].frames);
}

TEST_CASE("paths are taken from the recipe's folder and become absolute") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  std::filesystem::create_directories(folder / "recipes");
  for (const char* const name : {"in/a.mkv", "in/c.xml", "in/p.obj", "in/m.png"}) std::ofstream(folder / name) << "x";
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["backgrounds"][0]["footage"] = {
      {"video", "../in/a.mkv"}, {"calibration", "./../in/c.xml"}, {"own_body_mask", (folder / "in/m.png").string()}};
  json["aircraft"][0]["model"] = {{"file", "../in/p.obj"}};
  const Result<ReadRecipe> read = parse_recipe(json.dump(), folder / "recipes/set.json");
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->recipe.backgrounds[0].footage.video == (folder / "in/a.mkv").string());
  CHECK(read->recipe.backgrounds[0].footage.calibration == (folder / "in/c.xml").string());
  CHECK(read->recipe.backgrounds[0].footage.own_body_mask == (folder / "in/m.png").string());
  CHECK(read->recipe.aircraft[0].model.file == (folder / "in/p.obj").string());
}

TEST_CASE("settings apply to all videos, and a background's values override them") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["settings"] = {{"export.video.codec", "h264"},    {"export.video.crf", 30},
                      {"export.labels", {"xml", "csv"}}, {"camera.speed_mps", 11},
                      {"camera.attitude_deg.pitch", -3}, {"intruders[0].trajectory.bank", "level"}};
  const Plan plan = RecipeFolder().plan(json);
  const Project& project = plan.videos.at(0).project;
  CHECK(project.output.codec == VideoCodec::h264);
  CHECK(project.output.crf == 30);
  CHECK(project.output.labels == std::vector<std::string>{"xml", "csv"});
  CHECK(project.camera.speed_mps == 22);
  CHECK(project.camera.pitch_deg == -3);
  CHECK(project.intruders.at(0).trajectory.bank == Bank::level);
}

TEST_CASE("settings of the command line override the recipe's and give the same errors") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["settings"] = {{"export.video.crf", 30}, {"export.masks", "none"}};
  const auto read = [&](const std::string& setting) {
    return parse_recipe(json.dump(), RecipeFolder().file(), {setting});
  };
  const Result<ReadRecipe> good = read("export.video.crf=25");
  REQUIRE(good);
  CHECK(good->recipe.base.output.crf == 25);
  CHECK(good->recipe.base.output.masks == MasksChoice::none);
  CHECK(good->recipe.settings ==
        std::vector<std::string>{"export.video.crf=30", "export.masks=none", "export.video.crf=25"});
  for (const char* const wrong : {"export.video.crf=99", "export.video.crf", "footage.video=x", "a=b"}) {
    const Result<ReadRecipe> bad = read(wrong);
    REQUIRE_MESSAGE(!bad, wrong);
    CHECK(bad.error().kind == ErrorKind::usage);
    CHECK(bad.error().where == wrong);
  }
}

TEST_CASE("every whole number of 64 bits is a seed, and nothing else") {
  CHECK(read_with("/seed", 0).seed == 0);
  CHECK(read_with("/seed", 18446744073709551615u).seed == 18446744073709551615u);
  for (const nlohmann::ordered_json& wrong :
       {nlohmann::ordered_json(-1), nlohmann::ordered_json(1.5), nlohmann::ordered_json("7"),
        nlohmann::ordered_json(nullptr), nlohmann::ordered_json(1e30)})
    CHECK(
        error_with("/seed", wrong).starts_with("seed: expected a whole number from 0 to 18446744073709551615, found "));
}

TEST_CASE("each way of writing a quantity is read") {
  CHECK(quantity_with(12.5) == Quantity{.value = 12.5});
  CHECK(quantity_with({{"uniform", {1, 2}}}) == Quantity{.kind = Quantity::Kind::uniform, .low = 1, .high = 2});
  CHECK(quantity_with({{"choice", {3, 1, 2}}}) == Quantity{.kind = Quantity::Kind::choice, .choices = {3, 1, 2}});
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(quantity_with({{"normal", {{"mean", 5}, {"deviation", 2}, {"low", 1}}}}) ==
        Quantity{.kind = Quantity::Kind::normal, .low = 1, .high = infinite, .mean = 5, .deviation = 2});
}

TEST_CASE("invalid quantities are errors with their key") {
  const std::string key = "videos[0].flights[0].distance_m: ";
  const nlohmann::ordered_json half_normal{{"normal", {{"mean", 5}}}};
  const nlohmann::ordered_json far_off{{"normal", {{"mean", 0}, {"deviation", 1}, {"low", 9}}}};
  const nlohmann::ordered_json misspelt{{"normal", {{"mean", 5}, {"deviation", 2}, {"lo", 1}}}};
  CHECK(quantity_with({{"log_uniform", {1, 2}}}) == Quantity{.kind = Quantity::Kind::log_uniform, .low = 1, .high = 2});
  CHECK(quantity_error({{"log_uniform", {0, 2}}}).find("above 0") != std::string::npos);
  CHECK(quantity_error({{"uniform", {2, 1}}}) ==
        key + "expected {\"uniform\": [low, high]} with low <= high, found [2,1]");
  CHECK(quantity_error({{"choice", nlohmann::ordered_json::array()}}) ==
        key + "expected {\"choice\": [numbers]}, at least one, found []");
  CHECK(quantity_error(half_normal).starts_with(key + "expected {\"normal\": {\"mean\": m, \"deviation\": d"));
  CHECK(quantity_error(misspelt).starts_with(key + "expected {\"normal\": "));
  CHECK(quantity_error(far_off) ==
        key + "the bounds lie more than 8 deviations from the mean; nothing is left to sample");
  for (const nlohmann::ordered_json& wrong :
       {nlohmann::ordered_json("far"), nlohmann::ordered_json(nullptr), nlohmann::ordered_json(1e13),
        nlohmann::ordered_json{{"gauss", 3}}, nlohmann::ordered_json{{"uniform", {1}}},
        nlohmann::ordered_json{{"choice", {1, "x"}}}, nlohmann::ordered_json(true),
        nlohmann::ordered_json::array({1, 2})})
    CHECK_MESSAGE(quantity_error(wrong).starts_with(key + "expected "), wrong.dump());
}

TEST_CASE("errors of a recipe are reported with their key") {
  struct Case {
    const char* pointer;
    nlohmann::ordered_json value;
    std::string error;
  };
  const nlohmann::ordered_json far{{"kind", "encounter"}, {"closing_speed_mps", 5}};
  const nlohmann::ordered_json timeless{{"kind", "encounter"}, {"miss_distance_m", 5}};
  const nlohmann::ordered_json over{{"kind", "encounter"},
                                    {"miss_distance_m", 5},
                                    {"closing_speed_mps", 5},
                                    {"range_m", 500},
                                    {"time_of_closest_approach_s", 5}};
  const std::vector<Case> cases{
      {"/sigs_dataset", 2, "sigs_dataset: version 2 is not known; this program reads version 1"},
      {"/name", "", "name: is missing or empty; give it a text"},
      {"/name", "a/b",
       "name: becomes a file's name: it may hold no / and no control character and not begin with a dot"},
      {"/backgrounds", nlohmann::ordered_json::array(),
       "backgrounds: expected a list [{ ... }] of at least one, found []"},
      {"/backgrounds/0", 5, "backgrounds[0]: expected { ... }, found 5"},
      {"/backgrounds/0/name", 5, "backgrounds[0].name: expected a text in quotes, found 5"},
      {"/backgrounds/0/footage/video", "",
       "backgrounds[0].footage.video: is missing: the background: a video of a real flight, or its images: a folder, "
       "or a pattern as images/%06d.png"},
      {"/backgrounds/0/camera", 5, "backgrounds[0].camera: expected { ... }"},
      {"/backgrounds/0/camera/attitude_deg", 5, "backgrounds[0].camera.attitude_deg: expected { ... }"},
      {"/backgrounds/0/camera/speed_mps", "fast", "backgrounds[0].camera.speed_mps: expected a number, found \"fast\""},
      {"/backgrounds/0/camera/speed_mps", 5000,
       "backgrounds[0].camera.speed_mps: is 5000; it must lie between -1000 and 1000"},
      {"/backgrounds/0/tags", {{"sky", 5}}, "backgrounds[0].tags.sky: expected a text in quotes, found 5"},
      {"/backgrounds/0/tags", {{"flight", "x"}}, "backgrounds[0].tags.flight: is set by itself; choose another name"},
      {"/aircraft/0/model/up", "+x", "aircraft[0].model.up: lies along forward; up must be another axis"},
      {"/aircraft/0/category", "", "aircraft[0].category: is empty; labels count by it"},
      {"/aircraft/0/speed_limits_mps", {5, 1}, "aircraft[0].speed_limits_mps: expected [lowest, highest], found [5,1]"},
      {"/settings",
       {{"camera.sped_mps", 5}},
       "settings.camera.sped_mps: no such setting; did you mean camera.speed_mps?"},
      {"/settings", {{"export.video.crf", 99}}, "settings.export.video.crf: is 99; it must lie between 0 and 63"},
      {"/settings",
       {{"footage.video", "x"}},
       "settings.footage.video: is not the same for all videos; say it in backgrounds[].footage"},
      {"/settings", {{"name", "x"}}, "settings.name: is not the same for all videos; say it in videos[].name"},
      {"/videos", nlohmann::ordered_json::object(), "videos: expected a list [{ ... }] of at least one, found {}"},
      {"/videos/0/backgrounds", {"night"}, "videos[0].backgrounds[0]: no such name: \"night\"; there are day"},
      {"/videos/0/aircraft", {"jet", "jet"}, "videos[0].aircraft[0]: stands there twice: \"jet\""},
      {"/videos/0/aircraft", nlohmann::ordered_json::array(),
       "videos[0].aircraft: expected a list of names [\"...\"], found []"},
      {"/videos/0/flights", nlohmann::ordered_json::array(),
       "videos[0].flights: expected a list of at least one flight"},
      {"/videos/0/flights/0", "loop",
       "videos[0].flights[0].kind: is \"loop\"; there are left_right, right_left, approaching, moving_away, encounter, "
       "encounter_model, recorded, image_position"},
      {"/videos/0/flights/0", far,
       "videos[0].flights[0].miss_distance_m: is missing: distance at the closest point of approach"},
      {"/videos/0/flights/0", timeless, "videos[0].flights[0].closing_speed_mps: is missing; give it or range_m"},
      {"/videos/0/flights/0", over,
       "videos[0].flights[0].range_m: follows from closing_speed_mps and time_of_closest_approach_s; give two of the "
       "three"},
      {"/videos/0/count", 0, "videos[0].count: expected a whole number from 1 to 100000, found 0"},
      {"/videos/0/count", 1.5, "videos[0].count: expected a whole number from 1 to 100000, found 1.5"},
      {"/videos/0/frames", 0, "videos[0].frames: expected a whole number from 1 to 1000000000, found 0"},
      {"/videos/0/first_frame", -1, "videos[0].first_frame: must not be less than 0"},
      {"/videos/0/name", "{plane}",
       "videos[0].name: has no such part: {plane}; there are {background}, {aircraft}, {flight} and {number}"},
      {"/videos/0/split", "a/b",
       "videos[0].split: becomes a file's name: it may hold no / and no control character and not begin with a dot"},
      {"/splits", {{"train", 0.5}, {"test", 0.4}}, "splits: have shares that add up to 0.9, not 1"},
      {"/splits", {{"train", 2}, {"test", -1}}, "splits.train: expected a share from 0 to 1"},
      {"/splits", {{"train", "all"}}, "splits.train: expected a share from 0 to 1"},
  };
  for (const Case& c : cases) CHECK(error_with(c.pointer, c.value) == c.error);
}

TEST_CASE("a missing file is reported with its key, as an error of reading") {
  const RecipeFolder folder;
  const Result<ReadRecipe> read = folder.read(
      changed([](nlohmann::ordered_json& json) { json["backgrounds"][0]["footage"]["video"] = "no such clip.mp4"; }));
  REQUIRE(!read);
  CHECK(read.error().kind == ErrorKind::cannot_read);
  CHECK(read.error().where == folder.file().string() + ": backgrounds[0].footage.video");
  CHECK(read.error().what.starts_with("no such file: "));
}

TEST_CASE("duplicate names and unknown splits are errors") {
  const auto error = [](const std::function<void(nlohmann::ordered_json&)>& change) {
    return RecipeFolder().error(changed(change));
  };
  CHECK(error([](nlohmann::ordered_json& json) { json["backgrounds"].push_back(json["backgrounds"][0]); }) ==
        "backgrounds[1].name: stands there twice: \"day\"");
  CHECK(error([](nlohmann::ordered_json& json) {
          json["splits"] = {{"train", 0.5}, {"test", 0.5}};
          json["videos"][0]["split"] = "tset";
        }) == "videos[0].split: no such split: \"tset\"; there are train, test");
  CHECK(error([](nlohmann::ordered_json& json) {
          json["videos"][0]["count"] = 100'000;
          json["videos"].push_back(json["videos"][0]);
        }) == "videos: make 200000 videos; a recipe may have 100000");
}

TEST_CASE("unknown keys give warnings with their whole name, remarks do not") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["colour"] = 1;
  json["about"] = "a remark";
  json["backgrounds"][0]["about"] = "another";
  json["backgrounds"][0]["camera"]["attitude_deg"] = {{"rol", 1}};
  json["videos"][0]["flights"][0] = {{"kind", "left_right"}, {"bearing_deg", 5}};
  const RecipeFolder folder;
  const Result<ReadRecipe> read = folder.read(json);
  REQUIRE(read);
  std::vector<std::string> warned;
  for (const Warning& warning : read->warnings) warned.push_back(warning.text());
  const std::string file = folder.file().string() + ": ";
  const std::string end = ": unknown key, not used";
  CHECK(warned == std::vector<std::string>{file + "backgrounds[0].camera.attitude_deg.rol" + end,
                                           file + "videos[0].flights[0].bearing_deg" + end, file + "colour" + end});
}

TEST_CASE("text that is not a recipe is refused") {
  const RecipeFolder folder;
  const auto error = [&](const std::string& text) {
    const Result<ReadRecipe> read = parse_recipe(text, "r.json");
    REQUIRE(!read);
    CHECK(read.error().kind == ErrorKind::bad_data);
    return read.error().text();
  };
  CHECK(error("{\n  \"a\": }") == "r.json: is not JSON: unexpected text at line 2, column 8");
  CHECK(error("") == "r.json: is not JSON: unexpected text at line 1, column 1");
  CHECK(error("{\"sigs_dataset\": 1, \"seed\": 1e999}") == "r.json: holds a number that is too large");
  CHECK(error("[1]") == "r.json: is not a recipe: expected { ... }");
  CHECK(error("{}") == "r.json: sigs_dataset: missing; a recipe begins with \"sigs_dataset\": 1");
  CHECK(error("{\"sigs\": 1}") == "r.json: is a project, not a recipe; `sigs export` makes its video");
}

TEST_CASE("a missing recipe cannot be read") {
  const Result<ReadRecipe> read = read_recipe("/no/such/recipe.json");
  REQUIRE(!read);
  CHECK(read.error().kind == ErrorKind::cannot_read);
}
