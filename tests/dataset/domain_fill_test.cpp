// SPDX-License-Identifier: MIT
#include "dataset/domain_fill.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "base/staged_outputs.h"
#include "dataset/recipe_folder.h"
#include "dataset/tiny_plan.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

DesignDomain read_one(const std::string& conditions) {
  const Result<ReadDomain> read =
      parse_design_domain(R"({"sigs_domain": 1, "conditions": )" + conditions + "}", "odd.json");
  REQUIRE_MESSAGE(read, read.error().text());
  return read->domain;
}

DomainCoverage predicted(const DesignDomain& domain, const Plan& plan) {
  std::vector<const PlannedVideo*> videos;
  for (const PlannedVideo& video : plan.videos) videos.push_back(&video);
  Result<DomainCoverage> coverage = predicted_domain_coverage(domain, videos);
  REQUIRE_MESSAGE(coverage, coverage.error().text());
  return *std::move(coverage);
}

struct Filled {
  DomainFill fill;
  Plan plan;
};

// The recipe filled, written to another folder, read and planned there.
Filled filled(const nlohmann::ordered_json& json, const DesignDomain& domain) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a");
  std::filesystem::create_directories(folder / "b/c");
  write_file(folder / "a/set.json", json.dump());
  const Result<ReadRecipe> read = read_recipe(folder / "a/set.json");
  REQUIRE_MESSAGE(read, read.error().text());
  const Result<Plan> plan = plan_of(read->recipe);
  REQUIRE_MESSAGE(plan, plan.error().text());
  const Result<DomainFill> fill = filled_recipe(read->recipe, predicted(domain, *plan), {}, folder / "b/c/more.json");
  REQUIRE_MESSAGE(fill, fill.error().text());
  write_file(folder / "b/c/more.json", fill->recipe);
  const Result<ReadRecipe> again = read_recipe(folder / "b/c/more.json");
  REQUIRE_MESSAGE(again, again.error().text());
  CHECK(again->warnings.empty());
  Result<Plan> more = plan_of(again->recipe);
  REQUIRE_MESSAGE(more, more.error().text());
  CHECK(more->impossible.empty());
  for (const PlannedVideo& video : plan->videos)  // what was there stays as it was
    CHECK(std::ranges::any_of(
        more->videos, [&](const PlannedVideo& one) { return one.name == video.name && one.sampled == video.sampled; }));
  CHECK(more->videos.size() == plan->videos.size() + std::size_t(fill->videos));
  return {*fill, *std::move(more)};
}

nlohmann::ordered_json level_recipe() {
  nlohmann::ordered_json recipe = RecipeFolder::recipe();
  recipe["backgrounds"][0]["camera"]["attitude_deg"] = {{"roll", 0}, {"pitch", 0}};
  recipe["backgrounds"][0]["camera"]["position_m"] = {0, 0, -1500};
  recipe["backgrounds"][0]["tags"] = {{"light", "noon"}};
  recipe["aircraft"][0]["speed_limits_mps"] = {60, 260};
  recipe["videos"][0]["frames"] = 150;
  return recipe;
}

}  // namespace

TEST_CASE("a filled recipe covers every bin and every pair that can be, and says what cannot") {
  const DesignDomain domain = read_one(R"({
    "range_m": {"bins": [100, 300, 700, 1500]}, "aspect_deg": {"bins": [0, 45, 135, 180]},
    "closing_speed_mps": {"bins": [-100, 0, 100]}, "bearing_deg": {"bins": [-40, 0, 40]},
    "elevation_deg": {"bins": [-15, 0, 15]}, "size_px": {"bins": [10, 40, 200]},
    "horizon": {"values": ["above", "on", "below"]}, "light": {"values": ["noon", "dusk"]},
    "kind": {"values": ["airplane", "drone"]}, "background": {"values": ["day"]}})");
  const Filled made = filled(level_recipe(), domain);
  const DomainCoverage after = predicted(domain, made.plan);
  std::vector<std::string> empty;
  for (const DomainTarget& target : after.empty_bins()) empty.push_back(after.text_of(target));
  CHECK(empty == std::vector<std::string>{"light dusk", "kind drone"});
  // Pairs that stay empty: those of the two bins, and what geometry excludes. The camera flies at 22 m/s towards what
  // it sees, so a nose towards it closes, and a tail leaves at 60 m/s times the cosine of 45 degrees at least. An
  // airliner of 38 m before a lens of 561 px a radian has 71 px and more within 300 m, and 30 px at most from 700 m on.
  // The camera is level, so what is higher than its axis is above the horizon.
  for (const DomainTarget& target : after.empty_pairs()) {
    const std::string text = after.text_of(target);
    CAPTURE(text);
    const auto has = [&](const char* part) { return text.find(part) != std::string::npos; };
    const bool is_excluded = has("light dusk") || has("kind drone") ||
                             (has("aspect_deg 0 to 45") && has("closing_speed_mps -100 to 0")) ||
                             (has("aspect_deg 135 to 180") && has("closing_speed_mps 0 to 100")) ||
                             (has("range_m") && has("size_px")) || (has("elevation_deg") && has("horizon"));
    CHECK(is_excluded);
  }
  const auto says = [&](const std::string& what) {
    return std::ranges::any_of(made.fill.unfilled, [&](const std::string& line) { return line.starts_with(what); });
  };
  CHECK(says("light dusk: no background"));
  CHECK(says("kind drone: no aircraft"));
  CHECK(made.fill.videos > 0);
}

TEST_CASE("filling takes light and tags from the groups that have them, and keeps to what is asked for several times") {
  nlohmann::ordered_json recipe = level_recipe();
  recipe["videos"].push_back({{"name", "evening"},
                              {"flights", {"right_left"}},
                              {"frames", 150},
                              {"tags", {{"sun", "low"}}},
                              {"light", {{"ambient", 0.1}}}});
  recipe["splits"] = {{"train", 0.5}, {"test", 0.5}};
  DesignDomain domain = read_one(R"({"sun": {"values": ["low"]}, "range_m": {"bins": [800, 1200]}})");
  domain.min_encounters = 3;
  const Filled made = filled(recipe, domain);
  CHECK(made.fill.unfilled.empty());
  CHECK(predicted(domain, made.plan).pairs_covered() == std::pair{1LL, 1LL});
  int low = 0;
  for (const PlannedVideo& video : made.plan.videos) {
    if (!video.name.starts_with("fill-") || !video.tags.contains("sun")) continue;
    ++low;
    CHECK(video.project.light.ambient == 0.1);
    CHECK_FALSE(video.split.empty());
  }
  CHECK(low >= 3);
  CHECK(filled(recipe, domain).fill.recipe == made.fill.recipe);
}

TEST_CASE("a recipe of images is filled with images, and one that lacks nothing stays as it is") {
  nlohmann::ordered_json recipe = level_recipe();
  recipe.erase("videos");
  recipe["images"] = 3;
  const DesignDomain domain = read_one(R"({"range_m": {"bins": [2000, 3000]}, "closing_speed_mps": {"bins": [0, 9]},
                                           "camera_roll_deg": {"bins": [10, 20]}})");
  const Filled made = filled(recipe, domain);
  CHECK(made.fill.videos == 1);
  for (const PlannedVideo& video : made.plan.videos) CHECK(video.project.output.codec == VideoCodec::png);
  CHECK(predicted(domain, made.plan).conditions[0].bins[0].encounters == 1);
  REQUIRE(made.fill.unfilled.size() == 2);
  CHECK(made.fill.unfilled[0].find("an image tells no closing speed") != std::string::npos);
  CHECK(made.fill.unfilled[1].find("add a background") != std::string::npos);
  CHECK(filled(level_recipe(), read_one(R"({"kind": {"values": ["airplane"]}})")).fill.videos == 0);
}

TEST_CASE("what is predicted of a domain is what the annotations of the dataset say") {
  const TinyPlan tiny(4, 6);
  static_cast<void>(made(tiny.plan, {.folder = tiny.out(), .source = synthetic_source(), .jobs = 1}));
  const DesignDomain domain = read_one(R"({
    "range_m": {"bins": [0, 5, 20, 50]}, "bearing_deg": {"bins": [-60, -10, 0, 10, 60]},
    "aspect_deg": {"bins": [0, 45, 90, 135, 180]}, "elevation_deg": {"bins": [-30, 0, 30]},
    "closing_speed_mps": {"bins": [-100, 0, 100]}, "aircraft": {"values": ["cube"]}})");
  const Result<DomainCoverage> counted = counted_domain_coverage(domain, tiny.out());
  REQUIRE_MESSAGE(counted, counted.error().text());
  const DomainCoverage planned = predicted(domain, tiny.plan);
  CHECK(counted->in_view.encounters > 0);
  CHECK(counted->in_view == planned.in_view);
  for (std::size_t i = 0; i < domain.conditions.size(); ++i) {
    CAPTURE(domain.conditions[i].name);
    CHECK(counted->conditions[i].bins == planned.conditions[i].bins);
    CHECK(counted->conditions[i].untold == planned.conditions[i].untold);
  }
  CHECK(counted->pairs_covered() == planned.pairs_covered());
}
