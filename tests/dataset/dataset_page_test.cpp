// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/partial_file.h"
#include "dataset/flight_quantities.h"
#include "dataset/recipe.h"
#include "dataset/recipe_folder.h"
#include "dataset/short_text.h"
#include "docs/markdown.h"

namespace sigs::test {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_in_code(FlightKind kind) {
  Rows rows;
  for (const FlightQuantity& quantity : quantities_of(kind))
    rows.push_back({std::string(quantity.name), short_text(quantity.low) + " to " + short_text(quantity.high),
                    quantity.standard   ? short_text(*quantity.standard)
                    : quantity.required ? "needed"
                                        : "none",
                    std::string(quantity.help)});
  return rows;
}

}  // namespace

TEST_CASE("the dataset's page has the quantities of the flights as the program has them") {
  for (const FlightKind kind : {FlightKind::left_right, FlightKind::approaching, FlightKind::encounter}) {
    CAPTURE(name_of(kind));
    CHECK(table_rows(page("dataset.md"), "| " + std::string(name_of(kind)) + " | range | default | meaning |") ==
          rows_in_code(kind));
  }
}

TEST_CASE("the flights that the dataset's page calls alike differ in what it says alone") {
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
  const TemporaryFolder folder;
  const std::filesystem::path assets = source_dir() / "assets";
  std::filesystem::create_symlink(assets / "footage/sample.mp4", folder / "flight.mp4");
  std::filesystem::create_symlink(assets / "calibrations/sample.xml", folder / "camera.xml");
  std::filesystem::create_symlink(assets / "footage/sample_own_body.png", folder / "own_body.png");
  std::filesystem::create_symlink(assets / "models/airliner/airliner.obj", folder / "airliner.obj");
  const std::vector<std::string> examples = blocks(page("dataset.md"), "json");
  REQUIRE(examples.size() == 1);
  const Result<ReadRecipe> read = parse_recipe(examples[0], folder / "recipe.json");
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->warnings.empty());
  const Result<Plan> plan = plan_of(read->recipe);
  REQUIRE_MESSAGE(plan, plan.error().text());
  for (const ImpossibleVideo& video : plan->impossible) FAIL_CHECK(video.name << ": " << video.why);
  CHECK(plan->videos.size() == 48);
}

}  // namespace sigs::test
