// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dataset/recipe_folder.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// 200 videos of two aircraft with a bird or more beside them.
nlohmann::ordered_json varied_recipe() {
  const std::string models = (source_dir() / "assets/models").string();
  nlohmann::ordered_json recipe = RecipeFolder::recipe();
  recipe["aircraft"][0]["scale"] = {{"uniform", {0.5, 2}}};
  recipe["aircraft"][0]["liveries"] = {models + "/airliner/airliner.obj", models + "/airliner-grey/airliner-grey.obj",
                                       models + "/airliner-dark/airliner-dark.obj"};
  recipe["aircraft"].push_back(
      {{"name", "bird"}, {"category", "bird"}, {"distractor", true}, {"model", {{"file", models + "/bird/bird.obj"}}}});
  recipe["videos"][0] = {{"videos", 200},
                         {"frames", 10},
                         {"appearance",
                          {{"haze.visibility_m", {{"uniform", {2000, 20000}}}},
                           {"grain.seed", {{"uniform", {1, 1000}}}},
                           {"black", 0.01}}},
                         {"flights", {"left_right"}},
                         {"others",
                          {{{"aircraft", {"bird"}},
                            {"count", {{"uniform", {0, 3}}}},
                            {"flights", {{{"kind", "right_left"}, {"distance_m", {{"uniform", {10, 60}}}}}}}}}}};
  return recipe;
}

}  // namespace

TEST_CASE("size, livery, appearance and what else flies vary from video to video as their distributions say") {
  const RecipeFolder folder;
  const Plan plan = folder.plan(varied_recipe());
  REQUIRE(plan.videos.size() == 200);
  std::map<std::string, int> liveries;
  std::map<std::size_t, int> birds;
  double scales = 0;
  for (const PlannedVideo& video : plan.videos) {
    const Project& project = video.project;
    const IntruderSettings& jet = project.intruders.front();
    ++liveries[video.tags.at("livery")];
    ++birds[project.intruders.size() - 1];
    CHECK(jet.role == RoleChoice::intruder);
    CHECK(jet.model.scale == doctest::Approx(video.sampled.at("scale")));
    CHECK(video.sampled.at("scale") >= 0.5);
    CHECK(video.sampled.at("scale") < 2);
    scales += video.sampled.at("scale");
    CHECK(*project.appearance.haze.visibility_m == video.sampled.at("appearance.haze.visibility_m"));
    CHECK(project.appearance.grain.seed == std::floor(video.sampled.at("appearance.grain.seed")));
    CHECK(project.appearance.black == 0.01);
    std::set<std::string> names;
    for (const IntruderSettings& intruder : project.intruders) CHECK(names.insert(intruder.name).second);
    for (std::size_t i = 1; i < project.intruders.size(); ++i) {
      CHECK(project.intruders[i].role == RoleChoice::distractor);
      CHECK(project.intruders[i].category == "bird");
      CHECK(video.sampled.contains("other" + std::to_string(i) + ".distance_m"));
    }
    CHECK(project.output.categories == std::vector<std::string>{"airplane", "bird"});
  }
  // Means of 200: binomial deviations are 6.7 of 67 (three liveries, and 0, 1, 2 birds).
  CHECK(liveries.size() == 3);
  for (const auto& [livery, count] : liveries) CHECK(std::abs(count - 67) < 27);
  CHECK(birds.size() == 3);
  for (const auto& [number, count] : birds) CHECK(std::abs(count - 67) < 27);
  CHECK(std::abs(scales / 200 - 1.25) < 4 * 1.5 / std::sqrt(12.0 * 200));
}

TEST_CASE("what is sampled in addition changes no other sample of a video") {
  const RecipeFolder folder;
  nlohmann::ordered_json plain = varied_recipe();
  for (const char* const key : {"appearance", "others"}) plain["videos"][0].erase(key);
  const Plan with = folder.plan(varied_recipe());
  const Plan without = folder.plan(plain);
  REQUIRE(with.videos.size() == without.videos.size());
  for (std::size_t i = 0; i < with.videos.size(); ++i) {
    CHECK(with.videos[i].sampled.at("scale") == without.videos[i].sampled.at("scale"));
    CHECK(with.videos[i].tags.at("livery") == without.videos[i].tags.at("livery"));
  }
}

TEST_CASE("mistakes in what varies are named with their keys") {
  const RecipeFolder folder;
  const auto error_with = [&](const char* pointer, const nlohmann::ordered_json& value) {
    nlohmann::ordered_json recipe = varied_recipe();
    recipe[nlohmann::ordered_json::json_pointer(pointer)] = value;
    return folder.error(recipe);
  };
  CHECK(error_with("/aircraft/0/scale", 0).starts_with("aircraft[0].scale: "));
  CHECK(error_with("/aircraft/0/liveries", {"none.obj"}).starts_with("aircraft[0].liveries[0]: "));
  CHECK(error_with("/aircraft/1/distractor", "yes").starts_with("aircraft[1].distractor: "));
  CHECK(error_with("/videos/0/appearance/saturation", 9).starts_with("videos[0].appearance.saturation: "));
  CHECK(error_with("/videos/0/others/0/aircraft", {"owl"}).starts_with("videos[0].others[0].aircraft[0]: "));
  CHECK(error_with("/videos/0/others/0/count", -1).starts_with("videos[0].others[0].count: "));
  CHECK(error_with("/videos/0/others/0/flights", 3).starts_with("videos[0].others[0].flights: "));
  nlohmann::ordered_json unknown = varied_recipe();
  unknown["videos"][0]["appearance"]["haze.colour"] = 1;
  const Result<ReadRecipe> read = folder.read(unknown);
  REQUIRE(read);
  REQUIRE(read->warnings.size() == 1);
  CHECK(read->warnings[0].text().find("haze.colour") != std::string::npos);
}

TEST_CASE("a body that cannot fly so makes the video impossible, with the place in the list of others") {
  const RecipeFolder folder;
  nlohmann::ordered_json recipe = varied_recipe();
  recipe["videos"][0]["videos"] = 1;
  recipe["videos"][0]["redraws"] = 0;
  recipe["videos"][0]["others"][0]["count"] = 1;
  recipe["videos"][0]["others"][0]["flights"] = {
      {{"kind", "left_right"}, {"distance_m", 5000}, {"from_y_percent", 99}}};
  const Plan plan = folder.plan(recipe);
  REQUIRE(plan.impossible.size() == 1);
  CHECK_MESSAGE(plan.impossible[0].why.find("others[0].from_y_percent") != std::string::npos, plan.impossible[0].why);
}
