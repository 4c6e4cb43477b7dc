// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "dataset/footage_cache.h"
#include "dataset/recipe_folder.h"

using namespace sigs;
using namespace sigs::test;
namespace {

// Two parts of a clip, a fast and a slow aircraft.
nlohmann::ordered_json two_and_two(const nlohmann::ordered_json& videos) {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["seed"] = 3;
  json["backgrounds"].push_back(json["backgrounds"][0]);
  json["backgrounds"][0]["footage"]["last_frame"] = 99;
  json["backgrounds"][1]["name"] = "dusk";
  json["backgrounds"][1]["footage"]["first_frame"] = 100;
  json["aircraft"].push_back(json["aircraft"][0]);
  json["aircraft"][0]["speed_limits_mps"] = {60, 250};
  json["aircraft"][1]["name"] = "slow";
  json["aircraft"][1]["speed_limits_mps"] = {20, 80};
  json["videos"] = videos;
  return json;
}

// Passes below the camera, which flies 150 m high: half of all samples are underground.
nlohmann::ordered_json below(int videos) {
  return {{"name", "v{number}"},
          {"videos", videos},
          {"frames", 50},
          {"flights",
           {{{"kind", "encounter"},
             {"miss_distance_m", {{"uniform", {0, 300}}}},
             {"miss_angle_deg", -90},
             {"closing_speed_mps", 80},
             {"time_of_closest_approach_s", 9}}}}};
}

nlohmann::ordered_json one_group(const nlohmann::ordered_json& group) {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["videos"] = nlohmann::ordered_json::array({group});
  return json;
}

int sum_of(const std::map<std::string, int>& counts) {
  int sum = 0;
  for (const auto& [what, count] : counts) sum += count;
  return sum;
}

}  // namespace

TEST_CASE("thirty random encounters are all possible and visible") {
  const Plan plan = RecipeFolder().plan(two_and_two(30));
  CHECK(plan.impossible.empty());
  REQUIRE(plan.videos.size() == 30);
  std::vector<const PlannedVideo*> videos;
  std::map<std::string, int> made_of;
  for (const PlannedVideo& video : plan.videos) {
    videos.push_back(&video);
    for (const char* const tag : {"background", "aircraft"}) ++made_of[video.tags.at(tag)];
    const bool is_slow = video.tags.at("aircraft") == "slow";
    CHECK(video.sampled.at("speed_mps") >= (is_slow ? 20 : 60));
    CHECK(video.sampled.at("speed_mps") <= (is_slow ? 80 : 250));
    for (const WaypointSettings& waypoint : video.project.intruders.at(0).trajectory.waypoints)
      CHECK(waypoint.position_m.z <= 1e-6);
  }
  for (const std::optional<Visibility>& view : visibilities_of(videos, 1000, nullptr)) {
    REQUIRE(view);
    CHECK(view->visible > 0);
  }
  for (const char* const name : {"day", "dusk", "jet", "slow"}) CHECK_MESSAGE(made_of[name] > 0, name);
  CHECK(resamples_of(videos).contains("speed_mps"));
}

TEST_CASE(
    "helicopters fly as they do, at headings of their own where the recipe draws them; airplanes along their nose") {
  nlohmann::ordered_json json = two_and_two(
      {{{"name", "v{number}"},
        {"videos", 12},
        {"frames", 50},
        {"flights", {{{"kind", "image_position"}, {"size_px", 40}, {"nose_deg", {{"uniform", {-180, 180}}}}}}}}});
  for (auto& aircraft : json["aircraft"]) aircraft.erase("speed_limits_mps");
  json["aircraft"][1]["category"] = "helicopter";
  const Plan plan = RecipeFolder().plan(json);
  REQUIRE(plan.videos.size() == 12);
  std::set<double> headings;
  for (const PlannedVideo& video : plan.videos) {
    const TrajectoryPlan& trajectory = video.project.intruders.at(0).trajectory;
    const std::optional<double> heading_deg = trajectory.waypoints.at(0).heading_deg;
    if (video.tags.at("aircraft") == "slow") {
      CHECK(trajectory.attitude == AttitudeKind::helicopter);
      REQUIRE(heading_deg);
      headings.insert(*heading_deg);
      const glm::dvec3 way_m = trajectory.waypoints.back().position_m - trajectory.waypoints.front().position_m;
      const double off_deg = *heading_deg - std::atan2(way_m.y, way_m.x) * 180 / 3.14159265358979;
      CHECK(std::abs(std::remainder(off_deg - video.sampled.at("nose_deg"), 360)) < 1e-6);
    } else {
      CHECK(trajectory.attitude == AttitudeKind::path);
      CHECK_FALSE(heading_deg);
    }
  }
  CHECK(headings.size() > 3);
}

TEST_CASE("a sampled group that grows keeps the videos it had") {
  const Plan few = RecipeFolder().plan(two_and_two(5));
  const Plan many = RecipeFolder().plan(two_and_two(12));
  REQUIRE(few.videos.size() == 5);
  REQUIRE(many.videos.size() == 12);
  for (std::size_t i = 0; i < few.videos.size(); ++i) {
    CHECK(few.videos[i].name == many.videos[i].name);
    CHECK(few.videos[i].sampled == many.videos[i].sampled);
    CHECK(few.videos[i].tags == many.videos[i].tags);
    CHECK(few.videos[i].resamples == many.videos[i].resamples);
    CHECK(few.videos[i].project.intruders == many.videos[i].project.intruders);
  }
}

TEST_CASE("repeated samples are distributed evenly over the possible values") {
  constexpr int kVideos = 200;
  const Plan plan = RecipeFolder().plan(one_group(below(kVideos)));
  CHECK(plan.impossible.empty());
  REQUIRE(plan.videos.size() == kVideos);
  double sum_m = 0;
  int resamples = 0;
  std::set<double> different;
  for (const PlannedVideo& video : plan.videos) {
    const double miss_m = video.sampled.at("miss_distance_m");
    CHECK(miss_m <= 150);
    sum_m += miss_m;
    different.insert(miss_m);
    resamples += sum_of(video.resamples);
  }
  CHECK(different.size() == kVideos);
  // Uniform on 0..150: mean 75, deviation 150 / sqrt(12). Redraws are geometric with p = 1/2: mean 1, variance 2.
  CHECK(std::abs(sum_m / kVideos - 75) < 4 * 43.3 / std::sqrt(kVideos));
  CHECK(std::abs(resamples - kVideos) < 4 * std::sqrt(2.0 * kVideos));
}

TEST_CASE("where no sample can be used, the reasons are reported with their counts") {
  nlohmann::ordered_json group = below(2);
  group["redraws"] = 7;
  group["flights"][0]["miss_distance_m"] = {{"uniform", {200, 300}}};
  const Plan plan = RecipeFolder().plan(one_group(group));
  CHECK(plan.videos.empty());
  REQUIRE(plan.impossible.size() == 2);
  for (const ImpossibleVideo& video : plan.impossible) {
    CAPTURE(video.why);
    CHECK(video.why.find("none of 8 samples") != std::string::npos);
    CHECK(video.why.find("elevation_deg, miss_angle_deg 8 times") != std::string::npos);
    CHECK(video.why.find("underground") != std::string::npos);
  }
}

TEST_CASE("an intruder that is never in the image is sampled again only where the group asks for it") {
  nlohmann::ordered_json group{{"name", "v{number}"},
                               {"count", 20},
                               {"flights",
                                {{{"kind", "left_right"},
                                  {"from_x_percent", {{"choice", {-60, 20}}}},
                                  {"to_x_percent", {{"choice", {-50, 80}}}}}}}};
  const auto unseen = [&] {
    const Plan plan = RecipeFolder().plan(one_group(group));
    CHECK(plan.videos.size() == 20);
    return std::count_if(plan.videos.begin(), plan.videos.end(), [](const PlannedVideo& video) {
      return video.sampled.at("from_x_percent") < 0 && video.sampled.at("to_x_percent") < 0;
    });
  };
  CHECK(unseen() > 0);
  group["redraws"] = 50;
  CHECK(unseen() == 0);
}

TEST_CASE("backgrounds, aircraft and flights are sampled with equal probability") {
  nlohmann::ordered_json json = two_and_two(
      nlohmann::ordered_json::array({{{"videos", 400},
                                      {"flights",
                                       {{{"kind", "left_right"}, {"speed_mps", 70}},
                                        {{"kind", "left_right"}, {"name", "other"}, {"speed_mps", 71}}}}}}));
  const Plan plan = RecipeFolder().plan(json);
  REQUIRE(plan.videos.size() == 400);
  std::map<std::string, int> all;
  for (const PlannedVideo& video : plan.videos) {
    CHECK(video.resamples.empty());
    ++all[video.tags.at("background") + " " + video.tags.at("aircraft") + " " + video.tags.at("flight")];
  }
  CHECK(all.size() == 8);
  for (const auto& [what, count] : all) CHECK(std::abs(count - 50) < 27);  // 4 deviations of a binomial, p = 1/8
}

TEST_CASE("light is sampled from ranges and lists, and a background's settings override it") {
  nlohmann::ordered_json group{
      {"videos", 40},
      {"flights", {"left_right"}},
      {"light",
       {{{"position_m", {{{"uniform", {-50, 50}}}, 7, {{"choice", {-900, -800}}}}}, {"color", {1, 0.5, 0.25}}},
        {{"ambient", {{"uniform", {0.5, 0.75}}}}}}}};
  nlohmann::ordered_json json = one_group(group);
  json["backgrounds"][0]["light"] = {{"ambient", 0.1}, {"position_m", {1, 2, -3}}};
  int placed = 0;
  for (const PlannedVideo& video : RecipeFolder().plan(json).videos) {
    const LightSettings& light = video.project.light;
    if (light.position_m == glm::dvec3(1, 2, -3)) {
      CHECK(light.ambient >= 0.5);
      CHECK(light.ambient < 0.75);
      CHECK(video.sampled.at("light_ambient") == light.ambient);
      continue;
    }
    ++placed;
    CHECK(light.ambient == 0.1);
    CHECK(std::abs(light.position_m.x) <= 50);
    CHECK(light.position_m.y == 7);
    CHECK((light.position_m.z == -900 || light.position_m.z == -800));
    CHECK(light.color == glm::dvec3(1, 0.5, 0.25));
    CHECK(video.sampled.at("light_z_m") == light.position_m.z);
  }
  CHECK(placed > 5);
  CHECK(placed < 35);
  const RecipeFolder folder;
  const Result<ReadRecipe> read = parse_recipe(json.dump(), folder.file(), {"light.ambient=0.9"});
  REQUIRE(read);
  const Result<Plan> plan = plan_of(read->recipe);
  REQUIRE(plan);
  for (const PlannedVideo& video : plan->videos) CHECK(video.project.light.ambient == 0.9);
}

TEST_CASE("errors of a sampled group are reported with their key") {
  const auto error = [](const nlohmann::ordered_json& changes) {
    nlohmann::ordered_json group{{"videos", 3}, {"flights", {"left_right"}}};
    group.update(changes);
    return RecipeFolder().error(one_group(group));
  };
  CHECK(error({{"count", 2}}).starts_with("videos[0].count: "));
  CHECK(error({{"videos", 0}}).starts_with("videos[0].videos: "));
  CHECK(error({{"videos", 2.5}}).starts_with("videos[0].videos: "));
  CHECK(error({{"redraws", -1}}).starts_with("videos[0].redraws: "));
  CHECK(error({{"name", "{background}-{number}"}}).starts_with("videos[0].name: has {background}"));
  CHECK(error({{"name", "v"}}).starts_with("videos[0].name: is the same for 3 videos"));
  CHECK(error({{"light", 5}}).starts_with("videos[0].light: "));
  CHECK(error({{"light", {{"position_m", {1, 2}}}}}).starts_with("videos[0].light.position_m: "));
  CHECK(error({{"light", {{"ambient", {{"uniform", {0.5, 1.5}}}}}}}).starts_with("videos[0].light.ambient: must lie"));
  CHECK(error({{"light", {{"color", {1, -1, 1}}}}}).starts_with("videos[0].light.color[1]: must lie"));
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["videos"] = 0;
  CHECK(RecipeFolder().error(json).starts_with("videos: expected a whole number"));
}
