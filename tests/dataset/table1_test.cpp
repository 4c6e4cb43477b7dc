// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/staged_outputs.h"
#include "camera/camera.h"
#include "dataset/plan.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Table 1 of the paper: file name and number of frames.
const std::vector<std::pair<std::string, int>> kTable1{
    {"1LRB737", 322},  {"1FNB737", 389}, {"1NFB737", 636}, {"1RLB737", 275},  {"2LRB737", 337},  {"2FNB737", 318},
    {"2NFB737", 1143}, {"2RLB737", 363}, {"3LRB737", 353}, {"3FNB737", 1033}, {"3NFB737", 1033}, {"3RLB737", 1033},
    {"1LRC172", 321},  {"1FNC172", 411}, {"1NFC172", 636}, {"1RLC172", 274},  {"2LRC172", 342},  {"2FNC172", 287},
    {"2NFC172", 1143}, {"2RLC172", 347}, {"3LRC172", 337}, {"3FNC172", 1033}, {"3NFC172", 1033}, {"3RLC172", 1033}};

Plan plan_of_file(const std::string& name) {
  const Result<ReadRecipe> read = read_recipe(source_dir() / "projects/table1" / name);
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->warnings.empty());
  Result<Plan> plan = plan_of(read->recipe);
  REQUIRE_MESSAGE(plan, plan.error().text());
  return *std::move(plan);
}

}  // namespace

TEST_CASE("the recipe of Table 1 makes its 24 videos, named as there and in its order") {
  const Plan plan = plan_of_file("table1.json");
  CHECK(plan.impossible.empty());
  REQUIRE(plan.videos.size() == kTable1.size());
  for (std::size_t i = 0; i < kTable1.size(); ++i) {
    CHECK(plan.videos[i].name == kTable1[i].first);
    CHECK(plan.videos[i].tags.at("background") == plan.videos[i].name.substr(0, 1));
    CHECK(plan.videos[i].tags.at("flight") == plan.videos[i].name.substr(1, 2));
    CHECK(plan.videos[i].tags.at("aircraft") == plan.videos[i].name.substr(3));
    CHECK(plan.videos[i].project.camera.attitude_file.empty() == (plan.videos[i].name.front() != '3'));
  }
}

TEST_CASE("in the videos of Table 1 an intruder's span is 12 to 170 pixels in the first and in the last frame") {
  const std::map<std::string, double> span_m{{"B737", 34.04}, {"C172", 11.0}};  // assets/models/SOURCE.md
  for (const PlannedVideo& video : plan_of_file("table1.json").videos) {
    const Result<Camera> camera = read_calibration(video.project.footage.calibration, cv::Size(1280, 960));
    REQUIRE(camera);
    const double seconds = (*video.project.footage.last_frame - video.project.footage.first_frame) / 25.0;
    glm::dvec3 from_camera_m = video.project.intruders[0].trajectory.waypoints[0].position_m;
    from_camera_m -= video.project.camera.position_m;
    glm::dvec3 last_m = video.project.intruders[0].trajectory.waypoints[1].position_m;
    last_m -= video.project.camera.position_m + glm::dvec3(video.project.camera.speed_mps * seconds, 0, 0);
    for (const glm::dvec3& p_m : {from_camera_m, last_m}) {
      const double span_px =
          camera->lens.pixels_per_radian(p_m) * span_m.at(video.tags.at("aircraft")) / glm::length(p_m);
      CHECK_MESSAGE((span_px >= 12 && span_px <= 170), video.name << " " << span_px);
    }
  }
}

// The footage that this recipe names is made on demand, so it is read as text alone.
TEST_CASE("the recipe of Table 1 at full length has the paper's numbers of frames") {
  const Result<std::string> text = read_text(source_dir() / "projects/table1/full.json");
  REQUIRE(text);
  const auto json = nlohmann::ordered_json::parse(*text);
  std::vector<std::pair<std::string, int>> found;
  for (const auto& group : json.at("videos")) {
    found.emplace_back(group.at("name"), group.at("frames"));
    const std::string name = group.at("name");
    CHECK(group.at("backgrounds").at(0) == name.substr(0, 1));
    CHECK(group.at("aircraft").at(0) == name.substr(3));
    CHECK(group.at("flights").at(0).at("name") == name.substr(1, 2));
  }
  CHECK(found == kTable1);
}
