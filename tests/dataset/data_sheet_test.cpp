// SPDX-License-Identifier: MIT
#include "dataset/data_sheet.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "base/staged_outputs.h"
#include "dataset/entry.h"
#include "dataset/recipe_folder.h"
#include "dataset/tiny_plan.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

Json sheet_of(const std::filesystem::path& dataset, const GuessesByBackground& guesses = {}) {
  Result<Json> sheet = data_sheet_of(dataset, guesses);
  REQUIRE_MESSAGE(sheet, sheet.error().text());
  return *std::move(sheet);
}

bool has_text(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a data sheet counts what was made and names its inputs with the checksums that the files have") {
  TinyPlan tiny(4, 6);
  const std::string recipe = R"({"name": "tiny", "about": "Cubes.",
    "backgrounds": [{"name": "clip", "licence": "CC BY 4.0", "source": "a | b"}, {"name": "spare", "project": "p.json"}],
    "aircraft": [{"name": "cube"}]})";
  DatasetSource source = synthetic_source("test 2");
  source.recipe = recipe;
  const DatasetReport report = made(tiny.plan, {.folder = tiny.out(), .source = source, .jobs = 1});
  const Json sheet = sheet_of(tiny.out(), {{"spare", {"light.kind: the sun"}}});
  CHECK(sheet["name"] == "tiny");
  CHECK(sheet["about"] == "Cubes.");
  CHECK(sheet["program"] == "test 2");
  CHECK(sheet["recipe_sha256"] == checksum_of_text(recipe));
  CHECK(sheet["checksum"] == report.checksum);
  CHECK(sheet["counts"]["all"]["videos"] == 4);
  CHECK(sheet["counts"]["all"]["frames"] == 24);
  CHECK(sheet["counts"]["splits"]["train"]["videos"] == 3);
  CHECK(sheet["counts"]["splits"]["test"]["frames"] == 6);
  CHECK(sheet["counts"]["categories"]["airplane"]["intruders"] == 4);
  const Json& clip = sheet["footage"][0];
  const Project& project = tiny.plan.videos[0].project;
  CHECK(clip["licence"] == "CC BY 4.0");
  CHECK(clip["sha256"] == checksum_of_file(project.footage.video).value());
  CHECK(clip["video"] == std::filesystem::path(project.footage.video).filename().string());
  CHECK(clip["calibration"]["sha256"] == checksum_of_file(project.footage.calibration).value());
  CHECK(clip["calibration"]["reprojection_error_px"].is_null());
  CHECK(clip["frames"] == 24);
  CHECK_FALSE(sheet["footage"][1].contains("video"));

  const std::string text = data_sheet_text(sheet);
  CHECK(has_text(text, "a \\| b"));
  CHECK(has_text(text, "| test | 1 | 6 |"));
  CHECK(has_text(text, "- spare: guessed: light.kind: the sun\n"));
  CHECK(has_text(text, "stated in 0 of 24 frames"));
  CHECK(has_text(data_sheet_text(sheet_of(tiny.out())), "- spare: taken from a project; notes"));
}

TEST_CASE(
    "a data sheet says what labels state of attitudes, the horizon and clouds, and of missing inputs that they are") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "v");
  write_file(folder / "index.json", R"({"name": "n", "videos": [{"name": "v", "tags": {"background": "b"}}],
                                        "recipe": {"backgrounds": [{"name": "b"}], "aircraft": [{"name": "a"}]}})");
  write_file(folder / "v/v.xml", R"(<sigs version="1"><footage width="64" height="48" frame_rate="25/1"/>
    <frame index="0"><camera sd_x_deg="0.5" sd_y_deg="0.25" sd_z_deg="2" attitude_source="log"/>
      <intruder id="0" horizon="unknown"><box/><clouds hidden="0.5" assumed_distance_m="1500"/></intruder></frame>
    <frame index="1"><camera sd_x_deg="0.125" sd_y_deg="0" sd_z_deg="0"/></frame>
    <frame index="2"><camera sd_x_deg="180" sd_y_deg="180" sd_z_deg="180"/></frame>
    <frame index="3"><camera/></frame></sigs>)");
  const Json sheet = sheet_of(folder.path());
  const Json& sd = sheet["labels"]["attitude_sd"];
  CHECK(sd["frames"] == 4);
  CHECK(sd["frames_stated"] == 3);
  CHECK(sd["frames_unknown"] == 1);
  CHECK(sd["lowest_deg"] == 0.125);
  CHECK(sd["highest_deg"] == 2);
  CHECK(sheet["footage"][0]["frames_without_horizon"] == 1);
  CHECK(sheet["labels"]["cloud_distances_m"] == Json::array({1500.0}));
  CHECK(sheet["program"].is_null());
  const std::string text = data_sheet_text(sheet);
  CHECK(has_text(text, "made by | not stated"));
  CHECK(has_text(text, "file not found"));
  CHECK(has_text(text, "not known in 1 of 4 frames"));
  CHECK(has_text(text, "from 0.125 to 2 degrees"));
  CHECK(data_sheet_of(folder / "nowhere", {}).error().text().find("index.json") != std::string::npos);
  std::filesystem::remove(folder / "v/v.xml");
  CHECK(data_sheet_of(folder.path(), {}).error().text().find("export.labels") != std::string::npos);
}

TEST_CASE("the error of a calibration is read where files state it") {
  const auto error = [](const std::string& text) { return stated_reprojection_error_px(text).value_or(-1); };
  CHECK(error("<avg_reprojection_error>3.5e-01</avg_reprojection_error>") == 0.35);
  CHECK(error("%YAML:1.0\navg_reprojection_error: 0.25\n") == 0.25);
  CHECK(error(R"({"fisheye_params": {"RMS_error": 1.125, "camera_matrix": []}})") == 1.125);
  CHECK(error("image_width: 640\nrms: 0.5\n") == 0.5);
  CHECK(error("<camera_matrix/>") == -1);
  CHECK(error("avg_reprojection_error: .nan") == -1);
}

TEST_CASE("recipes take licence and source of backgrounds and aircraft as texts") {
  nlohmann::ordered_json recipe = RecipeFolder::recipe();
  for (const char* const list : {"backgrounds", "aircraft"}) {
    recipe[list][0]["licence"] = "MIT";
    recipe[list][0]["source"] = "own work";
  }
  const RecipeFolder folder;
  const Result<ReadRecipe> read = folder.read(recipe);
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->warnings.empty());
  recipe["aircraft"][0]["licence"] = 3;
  CHECK(has_text(folder.error(recipe), "aircraft[0].licence"));
}
