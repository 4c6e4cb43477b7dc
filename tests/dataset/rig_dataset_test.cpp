// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/tiny_project.h"
#include "dataset/plan.h"
#include "dataset/run.h"
#include "dataset/tiny_plan.h"
#include "export/export_project.h"
#include "project/json.h"
#include "project/project.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Two cameras with the tiny project's footage; the left one is turned and filmed a frame later.
struct RigRecipe {
  TinyProject tiny;
  json project = {{"sigs", 1}, {"name", "ring"}, {"camera", {{"speed_mps", 5}}}};
  json recipe = {
      {"sigs_dataset", 1},
      {"name", "set"},
      {"seed", 3},
      {"settings", {{"export.labels", {"xml", "coco", "mot"}}, {"export.masks", "none"}}},
      {"aircraft", {{{"name", "cube"}, {"model", {{"file", "cube.obj"}}}}}},
      {"splits", {{"train", 0.5}, {"test", 0.5}}},
      {"videos",
       {{{"name", "v{number}"},
         {"count", 4},
         {"flights", {{{"kind", "left_right"}, {"distance_m", {{"uniform", {20, 40}}}}}}}}}},
  };

  RigRecipe() {
    const json footage = {{"video", "clip.mkv"}, {"calibration", "lens.xml"}};
    project["cameras"] = {{{"name", "front"}, {"footage", footage}},
                          {{"name", "left"},
                           {"footage", footage},
                           {"mount", {{"position_m", {0, -1, 0}}, {"attitude_deg", {{"yaw", -15}}}}},
                           {"clock", {{"offset_s", 0.04}}}}};
    recipe["backgrounds"] = {{{"name", "ring"}, {"project", "ring.json"}}};
  }
  [[nodiscard]] Result<Plan> planned() const {
    write_file(tiny.file("ring.json"), project.dump());
    const Result<ReadRecipe> read = parse_recipe(recipe.dump(), tiny.file("set.json"));
    return read ? plan_of(read->recipe) : Result<Plan>(tl::unexpect, read.error());
  }
  [[nodiscard]] Plan plan() const {
    Result<Plan> plan = planned();
    if (!plan) FAIL(plan.error().text());
    return *std::move(plan);
  }
};

DatasetRequest request_of(const fs::path& folder, bool resume = false) {
  DatasetRequest request{.folder = folder, .source = synthetic_source(), .jobs = 1};
  request.resume = resume;
  return request;
}

}  // namespace

TEST_CASE("each camera of a background's aircraft is a video of the same flight, in the same split") {
  const Plan plan = RigRecipe().plan();
  REQUIRE(plan.videos.size() == 8);
  std::set<std::string> splits;
  for (std::size_t i = 0; i < plan.videos.size(); i += 2) {
    const PlannedVideo& front = plan.videos[i];
    const PlannedVideo& left = plan.videos[i + 1];
    CHECK(front.name == front.tags.at("rig") + ".front");
    CHECK(left.name == front.tags.at("rig") + ".left");
    CHECK(left.tags.at("camera") == "left");
    CHECK(left.project.name == left.name);
    CHECK(left.split == front.split);
    CHECK(left.sampled == front.sampled);
    CHECK(left.project.intruders == front.project.intruders);
    CHECK(left.project.rig_view->clock.offset_s == 0.04);
    REQUIRE(left.rig);
    CHECK(left.rig->cameras.size() == 2);
    splits.insert(front.split);
  }
  CHECK(splits == std::set<std::string>{"train", "test"});
  CHECK(plan.videos[0].sampled != plan.videos[2].sampled);
}

TEST_CASE("a recipe whose first camera does not look ahead, or with images of several cameras, is refused") {
  RigRecipe turned;
  turned.project["cameras"][0]["mount"] = {{"attitude_deg", {{"pitch", -5}}}};
  const Result<Plan> first = turned.planned();
  REQUIRE_FALSE(first);
  CHECK_MESSAGE(first.error().text().find("backgrounds[0].project") != std::string::npos, first.error().text());
  CHECK(first.error().text().find("\"front\"") != std::string::npos);
  RigRecipe images;
  images.recipe.erase("videos");
  images.recipe["images"] = 3;
  const Result<Plan> second = images.planned();
  REQUIRE_FALSE(second);
  CHECK_MESSAGE(second.error().text().find("several cameras") != std::string::npos, second.error().text());
}

TEST_CASE("a dataset of a rig has labels that name the cameras, and projects that make the same videos again") {
  RigRecipe recipe;
  recipe.recipe["videos"][0]["count"] = 2;
  const Plan plan = recipe.plan();
  const fs::path out = recipe.tiny.file("out");
  const DatasetReport report = made(plan, request_of(out));
  CHECK(report.exported == 4);

  const json index = json_of(out / "index.json");
  REQUIRE(index["videos"].size() == 4);
  CHECK(index["videos"][1]["tags"]["camera"] == "left");
  for (const std::string split : {"train", "test"}) {
    const json coco = json_of(out / "labels" / "coco" / (split + ".json"));
    REQUIRE(coco["videos"].size() == 2);
    CHECK(coco["videos"][0]["camera"]["name"] == "front");
    CHECK(coco["videos"][1]["camera"]["name"] == "left");
    for (const json& image : coco["images"])
      CHECK(image["camera"] == coco["videos"][image["video_id"].get<std::size_t>() - 1]["camera"]["name"]);
  }
  const std::string left = plan.videos[1].name;
  const Result<ReadProject> whole = read_project(out / left / (left + ".json"));
  REQUIRE_MESSAGE(whole, whole.error().text());
  REQUIRE(whole->project.cameras.size() == 2);
  const fs::path again = recipe.tiny.file("again");
  const Result<ExportReport> exported =
      export_project({.project = seen_by(whole->project, 1), .folder = again, .jobs = 1}, {});
  REQUIRE_MESSAGE(exported, exported.error().text());
  for (const char* const ending : {".mkv", ".xml", ".coco.json"})
    CHECK(text_of(again / (left + ending)) == text_of(out / left / (left + ending)));

  CHECK(made(plan, request_of(out, true)).kept == 4);
  recipe.project["cameras"][1]["clock"]["offset_s"] = 0.08;
  const DatasetReport anew = made(recipe.plan(), request_of(out, true));
  CHECK(anew.kept == 0);
  CHECK(anew.exported == 4);
}

}  // namespace sigs::test
