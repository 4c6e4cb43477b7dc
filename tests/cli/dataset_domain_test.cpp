// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/staged_outputs.h"
#include "cli/tiny_recipe.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

// Writes a domain of ranges and directions beside the recipe.
std::string write_domain(const TinyRecipe& recipe) {
  write_file(recipe.file("odd.json"),
             R"({"sigs_domain": 1, "name": "near", "conditions": {"range_m": {"bins": [1, 12, 40, 80]},
                 "bearing_deg": {"bins": [-20, 0, 20]}, "kind": {"values": ["airplane", "bird"]}}})");
  return "--domain " + recipe.out("odd.json");
}

nlohmann::json json_in(const fs::path& file) {
  return nlohmann::json::parse(read_text(file).value());
}

}  // namespace

TEST_CASE("a recipe is filled, and the filled one covers what the first did not") {
  const TinyRecipe recipe;
  const std::string domain = write_domain(recipe);
  const Run run = recipe.run("out", domain + " --fill " + recipe.out("more.json") + " --json " + recipe.out("a.json"));
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(has(run.out, "design domain near, predicted: 6 videos"));
  CHECK(has(run.err, "not filled: kind bird: no aircraft"));
  CHECK_FALSE(fs::exists(recipe.out("out")));
  const Run again = run_sigs("dataset " + recipe.out("more.json") + " --dry-run " + domain + " --json " +
                             recipe.out("b.json") + " --plot " + recipe.out("b.png"));
  CHECK_MESSAGE(again.status == 0, again.err);
  const nlohmann::json before = json_in(recipe.file("a.json")), after = json_in(recipe.file("b.json"));
  CHECK(before["pairs"]["covered"] < after["pairs"]["covered"]);
  CHECK(after["empty_bins"] == nlohmann::json::array({{{"condition", "kind"}, {"value", "bird"}}}));
  CHECK(fs::file_size(recipe.file("b.png")) > 1000);
}

TEST_CASE("a dataset that was made is counted against a domain, and described by a data sheet") {
  const TinyRecipe recipe;
  const std::string domain = write_domain(recipe);
  REQUIRE(recipe.run("out").status == 0);
  const Run by_folder = run_sigs("dataset " + recipe.out("out") + " " + domain);
  CHECK_MESSAGE(by_folder.status == 0, by_folder.err);
  CHECK(has(by_folder.out, "counted from the labels: 6 videos, 48 frames"));
  CHECK(recipe.run("out", "--coverage " + domain).out == by_folder.out);
  const Run sheet = run_sigs("dataset " + recipe.out("out") + " --data-sheet");
  CHECK_MESSAGE(sheet.status == 0, sheet.err);
  CHECK(has(sheet.out, "DATASHEET.md\n"));
  CHECK(json_in(fs::path(recipe.out("out")) / "datasheet.json")["counts"]["all"]["frames"] == 48);
  CHECK(recipe.run("out", "--data-sheet").status == 73);
  CHECK(recipe.run("out", "--data-sheet --force").status == 0);
}

TEST_CASE("options of domains and data sheets that do not go together are the command line's fault") {
  const TinyRecipe recipe;
  const std::string domain = write_domain(recipe), folder = recipe.file("").string();
  const auto status = [](const std::string& arguments) { return run_sigs("dataset " + arguments).status; };
  CHECK(status(folder + " " + domain + " --fill x.json") == 64);
  CHECK(status(folder) == 66);  // no dataset: a recipe that cannot be read
  CHECK(status(folder + " --data-sheet --coverage") == 64);
  CHECK(recipe.run("out", "--fill x.json --dry-run").status == 64);
  CHECK(recipe.run("out", "--merge " + domain).status == 64);
  CHECK(recipe.run("out", "--shard 1/2 --fill x.json " + domain).status == 64);
  CHECK(recipe.run("out", "--domain /nowhere.json").status == 66);
  write_file(recipe.file("odd.json"), R"({"sigs_domain": 1, "conditions": {"range_m": {"bins": [2, 2]}}})");
  CHECK(recipe.run("out", domain).status == 65);
  CHECK(run_sigs("dataset " + folder + " --data-sheet").status == 66);  // it has no index
}
