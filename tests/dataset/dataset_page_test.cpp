// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "dataset/flight_quantities.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"
#include "dataset/recipe_folder.h"
#include "docs/markdown.h"

namespace sigs::test {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_in_code(FlightKind kind) {
  Rows rows;
  for (const FlightQuantity& quantity : quantities_of(kind))
    rows.push_back({std::string(quantity.name),
                    short_number_text(quantity.low) + " to " + short_number_text(quantity.high),
                    quantity.standard   ? short_number_text(*quantity.standard)
                    : quantity.required ? "needed"
                                        : "none",
                    std::string(quantity.help)});
  return rows;
}

// A plan of the pages' n-th recipe, the guide's before the reference's, with the sample's files under the names that it
// uses.
Plan plan_of_example(std::size_t n) {
  const TemporaryFolder folder;
  const std::filesystem::path assets = source_dir() / "assets";
  std::filesystem::create_symlink(assets / "footage/sample.mp4", folder / "flight.mp4");
  std::filesystem::create_symlink(assets / "calibrations/sample.xml", folder / "camera.xml");
  std::filesystem::create_symlink(assets / "footage/sample_own_body.png", folder / "own_body.png");
  std::filesystem::create_symlink(assets / "models/airliner/airliner.obj", folder / "airliner.obj");
  std::filesystem::create_symlink(assets / "models/helicopter/helicopter.obj", folder / "helicopter.obj");
  write_file(folder / "seen.csv", "frame,label,x,y,w,h\n0,AIRPLANE,10,10,20,10\n");
  const std::vector<std::string> examples = blocks(page("dataset.md") + page("dataset-recipe.md"), "json");
  REQUIRE(examples.size() == 4);
  const Result<ReadRecipe> read = parse_recipe(examples.at(n), folder / "recipe.json");
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->warnings.empty());
  Result<Plan> plan = plan_of(read->recipe);
  REQUIRE_MESSAGE(plan, plan.error().text());
  for (const ImpossibleVideo& video : plan->impossible) FAIL_CHECK(video.name << ": " << video.why);
  return *std::move(plan);
}

}  // namespace

TEST_CASE("the recipe's page has the quantities of the flights as the program has them") {
  for (const FlightKind kind : {FlightKind::left_right, FlightKind::approaching, FlightKind::encounter,
                                FlightKind::encounter_model, FlightKind::recorded, FlightKind::image_position}) {
    CAPTURE(name_of(kind));
    CHECK(table_rows(page("dataset-recipe.md"), "| " + std::string(name_of(kind)) + " | range | default | meaning |") ==
          rows_in_code(kind));
  }
}

TEST_CASE("the flights that the recipe's page calls alike differ only as it states") {
  Rows right_left = rows_in_code(FlightKind::right_left);
  right_left[2][2] = std::string("5");
  right_left[3][2] = std::string("95");
  CHECK(right_left == rows_in_code(FlightKind::left_right));
  Rows moving_away = rows_in_code(FlightKind::moving_away);
  moving_away[0][2] = std::string("400");
  moving_away[1][2] = std::string("60");
  CHECK(moving_away == rows_in_code(FlightKind::approaching));
}

TEST_CASE("the recipe on the dataset's page makes its videos") {
  CHECK(plan_of_example(0).videos.size() == 48);
}

TEST_CASE("the recipe of balanced places and sizes on the recipe's page makes all its videos") {
  CHECK(plan_of_example(3).videos.size() == 60);
}

TEST_CASE("the recipe of images on the recipe's page makes all of them") {
  const Plan plan = plan_of_example(2);
  CHECK(plan.videos.size() == 1000);
  CHECK(plan.videos.back().name == "land-0200");
}

TEST_CASE("the recipe of random encounters on the recipe's page makes all its videos") {
  const Plan plan = plan_of_example(1);
  CHECK(plan.videos.size() == 30);
  std::map<std::string, int> of_tag;
  int resamples = 0;
  for (const PlannedVideo& video : plan.videos) {
    for (const char* const tag : {"background", "aircraft"}) ++of_tag[video.tags.at(tag)];
    for (const auto& [condition, count] : video.resamples) resamples += count;
    CHECK(video.project.light.ambient >= 0.2);
    CHECK(video.project.light.ambient < 0.5);
    CHECK(video.project.light.position_m.x == video.sampled.at("light_x_m"));
  }
  for (const char* const name : {"morning", "noon", "jet", "small"}) CHECK(of_tag[name] > 0);
  CHECK(resamples > 0);
}

}  // namespace sigs::test
