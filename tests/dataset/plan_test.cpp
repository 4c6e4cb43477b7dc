// SPDX-License-Identifier: MIT
#include "dataset/plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "dataset/recipe_folder.h"
#include "project/validate.h"

using namespace sigs;
using namespace sigs::test;
namespace {

// A recipe of sampled encounters, high up so that none is underground.
nlohmann::ordered_json encounters(int count) {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["backgrounds"][0]["camera"]["position_m"] = {0, 0, -9000};
  json["videos"] = {{{"name", "e{number}"},
                     {"count", count},
                     {"frames", 25},
                     {"first_frame", {{"uniform", {0, 100}}}},
                     {"flights",
                      {{{"kind", "encounter"},
                        {"miss_distance_m", {{"uniform", {0, 300}}}},
                        {"closing_speed_mps", {{"normal", {{"mean", 80}, {"deviation", 20}, {"low", 40}}}}},
                        {"bearing_deg", {{"uniform", {-60, 60}}}},
                        {"elevation_deg", {{"choice", {-5, 0, 5}}}}}}}}};
  return json;
}

std::vector<std::string> names_of(const Plan& plan) {
  std::vector<std::string> names;
  for (const PlannedVideo& video : plan.videos) names.push_back(video.name);
  return names;
}

const PlannedVideo& named(const Plan& plan, const std::string& name) {
  const auto found = std::find_if(plan.videos.begin(), plan.videos.end(),
                                  [&](const PlannedVideo& video) { return video.name == name; });
  REQUIRE(found != plan.videos.end());
  return *found;
}

}  // namespace

TEST_CASE("a group makes every combination, in the order of its lists") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["backgrounds"].push_back(json["backgrounds"][0]);
  json["backgrounds"][1]["name"] = "dusk";
  json["aircraft"].push_back(json["aircraft"][0]);
  json["aircraft"][1]["name"] = "prop";
  json["videos"] = {{{"name", "{background}.{aircraft}.{flight}.{number}"},
                     {"count", 2},
                     {"aircraft", {"prop"}},
                     {"flights", {"left_right", {{"kind", "approaching"}, {"name", "near"}}}}}};
  CHECK(names_of(RecipeFolder().plan(json)) ==
        std::vector<std::string>{"day.prop.left_right.0001", "day.prop.left_right.0002", "day.prop.near.0001",
                                 "day.prop.near.0002", "dusk.prop.left_right.0001", "dusk.prop.left_right.0002",
                                 "dusk.prop.near.0001", "dusk.prop.near.0002"});
}

TEST_CASE("every planned project is valid as far as can be checked without opening its files") {
  for (const PlannedVideo& video : RecipeFolder().plan(encounters(20)).videos) {
    for (const Problem& problem : validate(video.project)) FAIL_CHECK(problem.field << ": " << problem.what);
    CHECK(video.project.name == video.name);
    CHECK(video.project.intruders.size() == 1);
    CHECK(video.project.footage.video.starts_with("/"));
  }
}

TEST_CASE("a plan depends on the recipe alone") {
  const Plan one = RecipeFolder().plan(encounters(10));
  const Plan two = RecipeFolder().plan(encounters(10));
  REQUIRE(one.videos.size() == two.videos.size());
  for (std::size_t i = 0; i < one.videos.size(); ++i) {
    CHECK(one.videos[i].sampled == two.videos[i].sampled);
    CHECK(one.videos[i].project.intruders == two.videos[i].project.intruders);
  }
}

TEST_CASE("a video does not depend on the number of others or on other sampled quantities") {
  const Plan few = RecipeFolder().plan(encounters(3));
  nlohmann::ordered_json more = encounters(30);
  more["videos"].insert(more["videos"].begin(), nlohmann::ordered_json{{"flights", {"approaching"}}});
  more["videos"][1]["flights"][0]["miss_angle_deg"] = {{"uniform", {0, 360}}};
  const Plan many = RecipeFolder().plan(more);
  for (const PlannedVideo& video : few.videos) {
    const PlannedVideo& again = named(many, video.name);
    for (const char* const same :
         {"miss_distance_m", "closing_speed_mps", "bearing_deg", "elevation_deg", "first_frame"})
      CHECK(again.sampled.at(same) == video.sampled.at(same));
    CHECK(again.project.footage == video.project.footage);
  }
}

TEST_CASE("videos differ from each other and from those of another seed") {
  nlohmann::ordered_json json = encounters(50);
  std::set<double> distances;
  for (const std::uint64_t seed : {0u, 1u}) {
    json["seed"] = seed;
    for (const PlannedVideo& video : RecipeFolder().plan(json).videos)
      distances.insert(video.sampled.at("miss_distance_m"));
  }
  CHECK(distances.size() == 100);
}

TEST_CASE("frames of a video are the requested ones, within the background's range") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["backgrounds"][0]["footage"]["first_frame"] = 20;
  json["backgrounds"][0]["footage"]["last_frame"] = 149;
  const auto frames = [&](const nlohmann::ordered_json& group) {
    json["videos"] = {group};
    json["videos"][0]["flights"] = {"left_right"};
    const FootageSettings footage = RecipeFolder().plan(json).videos.at(0).project.footage;
    return std::pair(footage.first_frame, footage.last_frame.value());
  };
  CHECK(frames(nlohmann::ordered_json::object()) == std::pair(20, 149));
  CHECK(frames({{"frames", 50}}) == std::pair(20, 69));
  CHECK(frames({{"first_frame", 10}}) == std::pair(30, 149));
  CHECK(frames({{"frames", 1}, {"first_frame", 129}}) == std::pair(149, 149));
  CHECK(frames({{"frames", 130}}) == std::pair(20, 149));
}

TEST_CASE("a sampled first frame is a whole number and is recorded") {
  for (const PlannedVideo& video : RecipeFolder().plan(encounters(20)).videos) {
    const int first = video.project.footage.first_frame;
    CHECK(video.sampled.at("first_frame") == first);
    CHECK((first >= 0 && first < 100));
    CHECK(*video.project.footage.last_frame - first == 24);
    CHECK(*video.project.intruders[0].trajectory.waypoints[0].frame == first);
  }
}

TEST_CASE("impossible videos are named with their reason and left out, the others stay") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["videos"] = {
      {{"name", "good"}, {"flights", {"left_right"}}},
      {{"name", "low"},
       {"flights",
        {{{"kind", "encounter"}, {"miss_distance_m", 200}, {"miss_angle_deg", -90}, {"closing_speed_mps", 60}}}}},
      {{"name", "still"}, {"flights", {{{"kind", "encounter"}, {"miss_distance_m", 9}, {"closing_speed_mps", 0}}}}},
      {{"name", "long"}, {"frames", 201}, {"flights", {"left_right"}}},
      {{"name", "late"}, {"first_frame", 200}, {"flights", {"left_right"}}}};
  const Plan plan = RecipeFolder().plan(json);
  CHECK(names_of(plan) == std::vector<std::string>{"good"});
  REQUIRE(plan.impossible.size() == 4);
  CHECK(plan.impossible[0].name == "low");
  CHECK(plan.impossible[0].why ==
        "elevation_deg, miss_angle_deg: the intruder is underground in frame 0, 50 m below z = 0");
  CHECK(plan.impossible[1].name == "still");
  CHECK(plan.impossible[1].why.starts_with("closing_speed_mps: 0 m/s cannot meet the miss distance of 9 m"));
  CHECK(plan.impossible[2].why == "frames: the background has 200 frames, too few for 201 from its frame 0 on");
  CHECK(plan.impossible[3].why == "first_frame: the background has 200 frames, too few for any from its frame 200 on");
}

TEST_CASE("two videos of one name are an error, also where only case differs") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["videos"] = {{{"name", "a"}, {"flights", {"left_right"}}}, {{"name", "A"}, {"flights", {"left_right"}}}};
  CHECK(RecipeFolder().error(json) ==
        "videos[1].name: gives \"A\", which videos[0] gives already; names must differ in more than case, as by "
        "{number}");
  json["videos"] = {{{"name", "a"}, {"count", 2}, {"flights", {"left_right"}}}};
  CHECK(RecipeFolder().error(json).starts_with("videos[0].name: gives \"a\", which videos[0] gives already"));
  json["videos"] = {{{"name", "labels"}, {"flights", {"left_right"}}}};
  CHECK(RecipeFolder().error(json).starts_with("videos[0].name: gives \"labels\", which is kept for"));
}

TEST_CASE("numbers go on over the combinations that a pattern does not tell apart") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["backgrounds"].push_back(json["backgrounds"][0]);
  json["backgrounds"][1]["name"] = "dusk";
  json["videos"] = {{{"name", "near-{number}"}, {"count", 2}, {"flights", {"left_right"}}}};
  const Plan plan = RecipeFolder().plan(json);
  CHECK(names_of(plan) == std::vector<std::string>{"near-0001", "near-0002", "near-0003", "near-0004"});
  CHECK(named(plan, "near-0002").tags.at("background") == "day");
  CHECK(named(plan, "near-0003").tags.at("background") == "dusk");
  json["videos"][0]["name"] = "{background}-{number}";
  CHECK(names_of(RecipeFolder().plan(json)) ==
        std::vector<std::string>{"day-0001", "day-0002", "dusk-0001", "dusk-0002"});
}

TEST_CASE("tags state what a video is made of") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["backgrounds"][0]["tags"] = {{"sky", "clear"}, {"by", "background"}};
  json["aircraft"][0]["tags"] = {{"engines", "2"}, {"by", "aircraft"}};
  json["videos"][0]["tags"] = {{"by", "group"}};
  CHECK(RecipeFolder().plan(json).videos.at(0).tags == std::map<std::string, std::string>{{"aircraft", "jet"},
                                                                                          {"background", "day"},
                                                                                          {"by", "group"},
                                                                                          {"engines", "2"},
                                                                                          {"flight", "left_right"},
                                                                                          {"sky", "clear"}});
}

TEST_CASE("all videos count the categories of all aircraft, in the recipe's order") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  json["aircraft"].push_back(json["aircraft"][0]);
  json["aircraft"][1]["name"] = "glider";
  json["aircraft"][1]["category"] = "glider";
  for (const PlannedVideo& video : RecipeFolder().plan(json).videos)
    CHECK(video.project.output.categories == std::vector<std::string>{"airplane", "glider"});
  json["settings"] = {{"export.categories", {"bird", "airplane"}}};
  CHECK(RecipeFolder().error(json) ==
        "video day-glider-left_right: intruders[0].category: is \"glider\", which export.categories does not have");
}

TEST_CASE("backgrounds kept together share a split, and a tag that a video lacks is an error") {
  nlohmann::ordered_json json = encounters(10);
  for (const char* const name : {"b", "c", "d"}) {
    json["backgrounds"].push_back(json["backgrounds"][0]);
    json["backgrounds"].back()["name"] = name;
  }
  json["videos"][0]["name"] = "{background}{number}";
  json["splits"] = {{"train", 0.5}, {"test", 0.5}, {"keep_together", "background"}};
  const Plan plan = RecipeFolder().plan(json);
  std::map<std::string, std::set<std::string>> found;
  for (const PlannedVideo& video : plan.videos) found[video.tags.at("background")].insert(video.split);
  CHECK(found.size() == 4);
  std::map<std::string, int> backgrounds;
  for (const auto& [background, splits] : found) {
    CHECK(splits.size() == 1);
    ++backgrounds[*splits.begin()];
  }
  CHECK(backgrounds == std::map<std::string, int>{{"test", 2}, {"train", 2}});
  json["splits"]["keep_together"] = "sky";
  CHECK(RecipeFolder().error(json) == "splits.keep_together: video day0001 has no tag \"sky\"");
}

TEST_CASE("a group's fixed split is kept beside sampled ones") {
  nlohmann::ordered_json json = encounters(10);
  json["splits"] = {{"train", 1}, {"test", 0}};
  json["videos"].push_back({{"name", "extra"}, {"split", "test"}, {"flights", {"left_right"}}});
  const Plan plan = RecipeFolder().plan(json);
  CHECK(named(plan, "extra").split == "test");
  CHECK(named(plan, "e0001").split == "train");
}

TEST_CASE("unusable footage and calibrations are reported with the background's key") {
  nlohmann::ordered_json json = RecipeFolder::recipe();
  const std::string model = json["aircraft"][0]["model"]["file"];
  json["backgrounds"][0]["footage"]["video"] = model;
  CHECK(RecipeFolder().error(json).starts_with("backgrounds[0].footage.video: " + model));
  json = RecipeFolder::recipe();
  json["backgrounds"][0]["footage"]["calibration"] = model;
  CHECK(RecipeFolder().error(json).starts_with("backgrounds[0].footage.calibration: "));
  json = RecipeFolder::recipe();
  json["backgrounds"][0]["footage"]["last_frame"] = 200;
  CHECK(RecipeFolder().error(json) == "backgrounds[0].footage.last_frame: the footage has frames 0 to 199");
}

TEST_CASE("a log is taken where it has the attitude alone, or its positions are left out") {
  const RecipeFolder folder;
  const TemporaryFolder logs;
  const auto error_with = [&](const std::string& columns, const std::string& values, const char* position) {
    std::string text = "time_s,camera_roll_deg,camera_pitch_deg,camera_yaw_deg" + columns + "\n";
    for (int i = 0; i < 20; ++i) text += std::to_string(i) + ",0," + std::to_string(i % 3) + ",0" + values + "\n";
    write_file(logs / "log.csv", text);
    nlohmann::ordered_json recipe = RecipeFolder::recipe();
    recipe["backgrounds"][0]["camera"]["track"] = {{"file", (logs / "log.csv").string()}};
    if (position != nullptr) recipe["backgrounds"][0]["camera"]["track"]["position"] = position;
    return folder.error(recipe);
  };
  CHECK(error_with("", "", nullptr) == "");
  CHECK(error_with(",north_m,east_m,down_m", ",1,2,3", nullptr).find("camera.track.position: is not \"none\"") !=
        std::string::npos);
  CHECK(error_with(",north_m,east_m,down_m", ",1,2,3", "none") == "");
}
