// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>
#include <set>

#include "dataset/coverage.h"
#include "dataset/entry.h"
#include "dataset/footage_cache.h"
#include "dataset/recipe_folder.h"
#include "dataset/tiny_plan.h"
#include "export/export_project.h"
#include "support/files.h"

using namespace sigs;
using namespace sigs::test;

namespace {

nlohmann::ordered_json image_recipe(const nlohmann::ordered_json& group) {
  nlohmann::ordered_json recipe = RecipeFolder::recipe();
  recipe["backgrounds"][0]["camera"]["position_m"] = {0, 0, -3000};
  recipe["videos"] = {group};
  return recipe;
}

// The box of an intruder, by the estimate that reads no pixel.
Box box_in(const PlannedVideo& image, int intruder) {
  VideoVisibility opener;
  const std::optional<Scene> scene = opener.scene_of(image.project);
  REQUIRE(scene);
  return VisibilityEstimator(*scene).at(intruder, image.project.footage.first_frame).silhouette.value();
}

}  // namespace

TEST_CASE("a number of images is a recipe: any frame, any place, 8 to 128 px, in the formats of detectors") {
  nlohmann::ordered_json recipe = image_recipe({});
  recipe.erase("videos");
  recipe["images"] = 300;
  const Plan plan = RecipeFolder().plan(recipe);
  REQUIRE(plan.videos.size() == 300);
  CHECK(plan.videos.front().name == "image-0001");
  double frames = 0, sizes = 0, columns = 0;
  for (const PlannedVideo& image : plan.videos) {
    const Project& project = image.project;
    CHECK(project.footage.first_frame == *project.footage.last_frame);
    CHECK(project.footage.first_frame == image.sampled.at("first_frame"));
    CHECK(project.output.codec == VideoCodec::png);
    CHECK(project.output.masks == MasksChoice::none);
    CHECK(project.output.labels == std::vector<std::string>{"xml", "coco", "yolo"});
    REQUIRE(project.intruders.size() == 1);
    frames += project.footage.first_frame;
    sizes += std::log2(image.sampled.at("size_px"));
    columns += image.sampled.at("x_percent");
  }
  // Means of 300 even samples: within four deviations. The sample footage has 200 frames; sizes run over four octaves.
  CHECK(std::abs(frames / 300 - 99.5) < 4 * 200 / std::sqrt(12.0 * 300));
  CHECK(std::abs(sizes / 300 - 5) < 4 * 4 / std::sqrt(12.0 * 300));
  CHECK(std::abs(columns / 300 - 50) < 4 * 100 / std::sqrt(12.0 * 300));
}

TEST_CASE("images show as many aircraft as drawn, none too, however often the others are sampled again") {
  const Plan plan = RecipeFolder().plan(image_recipe({{"images", 200}, {"per_image", {{"choice", {0, 1, 3}}}}}));
  REQUIRE(plan.videos.size() == 200);
  std::map<std::size_t, int> counts;
  for (const PlannedVideo& image : plan.videos) {
    ++counts[image.project.intruders.size()];
    CHECK(image.sampled.at("per_image") == double(image.project.intruders.size()));
    CHECK((image.tags.at("aircraft") == "none") == image.project.intruders.empty());
  }
  CHECK(counts.size() == 3);
  for (const auto& [count, images] : counts) CHECK(std::abs(images - 67) < 27);  // deviation 6.7
}

TEST_CASE("course and climb say where an aircraft at a place of the image flies, whatever the camera's pitch") {
  const nlohmann::ordered_json flight{{"kind", "image_position"}, {"distance_m", 700},  {"x_percent", 30},
                                      {"relative_speed_mps", 50}, {"course_deg", -120}, {"climb_deg", 10}};
  const Plan plan = RecipeFolder().plan(image_recipe(
      {{"images", 20}, {"camera", {{"attitude_deg.pitch", {{"uniform", {-20, 60}}}}}}, {"flights", {flight}}}));
  REQUIRE(plan.videos.size() == 20);
  std::set<double> pitches;
  for (const PlannedVideo& image : plan.videos) {
    const Project& project = image.project;
    pitches.insert(*project.camera.pitch_deg);
    CHECK(*project.camera.pitch_deg == image.sampled.at("camera.attitude_deg.pitch"));
    const auto& waypoints = project.intruders.front().trajectory.waypoints;
    REQUIRE(waypoints.size() == 2);
    const double interval_s = 1 / 25.0;
    const double camera_x_m = 22 * project.footage.first_frame * interval_s;
    CHECK(glm::distance(waypoints[0].position_m, {camera_x_m, 0, -3000}) == doctest::Approx(700).epsilon(1e-4));
    const glm::dvec3 relative_mps =
        (waypoints[1].position_m - waypoints[0].position_m) / interval_s - glm::dvec3(22, 0, 0);
    const double degree = std::numbers::pi / 180;
    const glm::dvec3 expected =
        50.0 * glm::dvec3(std::cos(10 * degree) * std::cos(-120 * degree),
                          std::cos(10 * degree) * std::sin(-120 * degree), -std::sin(10 * degree));
    CHECK(glm::distance(relative_mps, expected) < 0.1);  // waypoints are rounded to 2^-10 m
  }
  CHECK(pitches.size() > 15);
}

TEST_CASE("images are placed before sky or before land as the frame shows it, and never over a real aircraft") {
  // In the sample footage the horizon is in the middle of the image, within some percent, and clouds are above it.
  for (const char* const placement : {"sky", "land"}) {
    CAPTURE(placement);
    const Plan plan = RecipeFolder().plan(image_recipe({{"images", 40}, {"placement", placement}}));
    REQUIRE(plan.videos.size() == 40);
    const bool is_sky = std::string(placement) == "sky";
    int beyond = 0;
    for (const PlannedVideo& image : plan.videos) {
      const Box box = box_in(image, 0);
      const double middle_percent = 100 * (box.y + box.height / 2) / 960;
      beyond += (middle_percent < 50) == is_sky ? 0 : 1;
    }
    CHECK(beyond == 0);
    std::vector<const PlannedVideo*> all;
    for (const PlannedVideo& image : plan.videos) all.push_back(&image);
    CHECK(resamples_of(all).contains("placement"));
    const Coverage coverage = predicted_coverage(all).value();
    CHECK(coverage.intruders.before[is_sky ? 0 : 1] == coverage.intruders.sights);
    CHECK(coverage_text(coverage, "predicted").find("\nbefore ") != std::string::npos);
  }
  const TemporaryFolder folder;
  std::string csv = "frame,label,x,y,w,h\n";
  for (int frame = 0; frame < 200; ++frame) csv += std::to_string(frame) + ",A,1,1,900,960\n";
  write_file(folder / "real.csv", csv);
  nlohmann::ordered_json recipe = image_recipe({{"images", 40}});
  recipe["backgrounds"][0]["footage"]["real_aircraft"] = (folder / "real.csv").string();
  const Plan plan = RecipeFolder().plan(recipe);
  REQUIRE(plan.videos.size() == 40);
  for (const PlannedVideo& image : plan.videos) CHECK(box_in(image, 0).x >= 899.5);
}

TEST_CASE("a background may be a project, whose camera, light and look it has; groups draw numbers of the light") {
  const TemporaryFolder folder;
  const std::filesystem::path assets = source_dir() / "assets";
  const nlohmann::ordered_json project{
      {"sigs", 1},
      {"footage",
       {{"video", (assets / "footage/sample.mp4").string()},
        {"calibration", (assets / "calibrations/sample.xml").string()}}},
      {"camera", {{"position_m", {0, 0, -2000}}, {"attitude_deg", {{"roll", 1}, {"pitch", 7}}}}},
      {"light", {{"kind", "sun"}, {"exposure", 1.25}}},
      {"appearance", {{"psf_sigma_px", 0.81}}}};
  write_file(folder / "clip.json", project.dump());
  nlohmann::ordered_json recipe = image_recipe(
      {{"images", 12}, {"light", {{"sun.azimuth_deg", {{"uniform", {-180, 180}}}}, {"sun.elevation_deg", 30}}}});
  recipe["backgrounds"][0] = {
      {"name", "day"}, {"project", (folder / "clip.json").string()}, {"camera", {{"speed_mps", 5}}}};
  const Plan plan = RecipeFolder().plan(recipe);
  REQUIRE(plan.videos.size() == 12);
  std::set<double> azimuths;
  for (const PlannedVideo& image : plan.videos) {
    const Project& made = image.project;
    CHECK(*made.camera.pitch_deg == 7);
    CHECK(made.camera.speed_mps == 5);
    CHECK(made.light.kind == LightKind::sun);
    CHECK(made.light.exposure == 1.25);
    CHECK(*made.light.sun.elevation_deg == 30);
    CHECK(made.appearance.psf_sigma_px == 0.81);
    azimuths.insert(*made.light.sun.azimuth_deg);
    CHECK(image.sampled.at("light.sun.azimuth_deg") == *made.light.sun.azimuth_deg);
  }
  CHECK(azimuths.size() == 12);
  recipe["backgrounds"][0]["project"] = (folder / "none.json").string();
  CHECK(RecipeFolder().error(recipe).starts_with("backgrounds[0].project: "));
}

TEST_CASE("recipes draw a contrail by aircraft, where it flies high enough") {
  nlohmann::ordered_json recipe = image_recipe({{"images", 40}});
  recipe["aircraft"][0]["contrail"] = {
      {"strands", {{"choice", {1, 2, 4}}}}, {"opacity", {{"uniform", {0.2, 0.8}}}}, {"above_m", 3000}};
  const Plan plan = RecipeFolder().plan(recipe);
  int with = 0;
  for (const PlannedVideo& image : plan.videos) {
    const IntruderSettings& jet = image.project.intruders.front();
    const bool is_high = -jet.trajectory.waypoints.front().position_m.z >= 3000;
    CHECK((jet.contrail.strands > 0) == is_high);
    CHECK(image.sampled.contains("contrail.opacity") == is_high);
    with += is_high ? 1 : 0;
  }
  CHECK(with > 5);
  CHECK(with < 35);
  recipe["aircraft"][0]["contrail"] = {{"strands", 7}};
  CHECK(RecipeFolder().error(recipe).starts_with("aircraft[0].contrail.strands: must lie between 0 and 4"));
}

TEST_CASE("recipes draw an aircraft's gloss, and state its rotors as projects do") {
  nlohmann::ordered_json recipe = image_recipe({{"images", 12}});
  recipe["aircraft"][0]["gloss"] = {{"uniform", {0.5, 2}}};
  recipe["aircraft"][0]["model"]["rotors"] = {{{"part", "fan"}, {"blades", 0}, {"rpm", 900}}};
  std::set<double> drawn;
  const Plan plan = RecipeFolder().plan(recipe);
  for (const PlannedVideo& image : plan.videos) {
    const ModelSettings& model = image.project.intruders.front().model;
    CHECK(model.gloss == image.sampled.at("model.gloss"));
    drawn.insert(model.gloss);
    REQUIRE(model.rotors.size() == 1);
    CHECK(model.rotors[0].part == "fan");
    CHECK(model.rotors[0].blades == 0);
    CHECK(model.rotors[0].rpm == 900);
  }
  CHECK(drawn.size() == 12);
  CHECK(*drawn.begin() >= 0.5);
  CHECK(*drawn.rbegin() <= 2);
  recipe["aircraft"][0]["model"]["rotors"][0]["pitch_deg"] = 5;
  const std::vector<Warning> warnings = RecipeFolder().read(recipe).value().warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].text().find("aircraft[0].model.rotors[0].pitch_deg: unknown key") != std::string::npos);
  recipe["aircraft"][0]["model"]["rotors"][0]["blades"] = 17;
  CHECK(RecipeFolder().error(recipe).starts_with("aircraft[0].model.rotors[0].blades: "));
  recipe["aircraft"][0]["model"]["rotors"][0] = {{"part", "fann"}};
  CHECK(RecipeFolder().error(recipe).starts_with("aircraft[0].model.rotors[0].part: the model has no material, group"));
  recipe["aircraft"][0]["model"]["rotors"] = 3;
  CHECK(RecipeFolder().error(recipe).starts_with("aircraft[0].model.rotors: expected a list"));
  recipe["aircraft"][0]["model"].erase("rotors");
  recipe["aircraft"][0]["gloss"] = -1;
  CHECK(RecipeFolder().error(recipe).starts_with("aircraft[0].gloss: must lie between 0 and 100"));
}

TEST_CASE("recipes draw how far the footage's clouds are, and nothing else of the clip") {
  nlohmann::ordered_json recipe = image_recipe(
      {{"images", 12}, {"footage", {{"cloud_distance_m", {{"uniform", {500, 4000}}}}, {"cloud_depth_m", 50}}}});
  std::set<double> distances_m;
  for (const PlannedVideo& image : RecipeFolder().plan(recipe).videos) {
    REQUIRE(image.project.footage.cloud_distance_m);
    distances_m.insert(*image.project.footage.cloud_distance_m);
    CHECK(image.sampled.at("footage.cloud_distance_m") == *image.project.footage.cloud_distance_m);
    CHECK(image.project.footage.cloud_depth_m == 50);
  }
  CHECK(distances_m.size() == 12);
  CHECK(*distances_m.begin() >= 500);
  CHECK(*distances_m.rbegin() <= 4000);
  for (const PlannedVideo& image :
       RecipeFolder().plan(image_recipe({{"images", 12}, {"footage", {{"frame_rate", 3}}}})).videos)
    CHECK_FALSE(image.project.footage.frame_rate_hz);  // it is the clip's; a warning says so
}

TEST_CASE("recipes draw the heat of an aircraft's parts, and the halo of a thermal camera") {
  nlohmann::ordered_json recipe =
      image_recipe({{"images", 12}, {"appearance", {{"thermal.halo", {{"uniform", {0.1, 0.6}}}}}}});
  recipe["backgrounds"][0]["footage"]["spectrum"] = "thermal";
  recipe["aircraft"][0]["heat"] = {{"skin", {{"uniform", {60, 300}}}}, {"engine", 700}};
  std::set<double> skins;
  for (const PlannedVideo& image : RecipeFolder().plan(recipe).videos) {
    CHECK(image.project.footage.spectrum == Spectrum::thermal);
    const HeatSettings& heat = image.project.intruders.front().heat;
    CHECK(heat.skin >= 60);
    CHECK(heat.skin <= 300);
    CHECK(heat.engine == 700);
    CHECK(heat.glass == HeatSettings{}.glass);
    CHECK(image.sampled.at("heat.skin") == heat.skin);
    CHECK(image.project.appearance.thermal.halo <= 0.6);
    CHECK(image.sampled.contains("appearance.thermal.halo"));
    skins.insert(heat.skin);
  }
  CHECK(skins.size() == 12);
  recipe["aircraft"][0]["heat"] = {{"skin", -5}};
  CHECK(RecipeFolder().error(recipe).starts_with("aircraft[0].heat.skin: must lie between 0 and 10000"));
}

TEST_CASE("what is wrong with a group of images is named") {
  const RecipeFolder folder;
  const auto error = [&](const nlohmann::ordered_json& group) { return folder.error(image_recipe(group)); };
  const nlohmann::ordered_json place{{"kind", "image_position"}, {"size_px", 20}};
  const auto with = [&](const char* key, const nlohmann::ordered_json& value) {
    nlohmann::ordered_json flight = place;
    flight[key] = value;
    return error({{"images", 3}, {"flights", {flight}}});
  };
  CHECK(
      error({{"images", 3}, {"flights", {"left_right"}}}).starts_with("videos[0].flights[0].kind: must be image_pos"));
  CHECK(error({{"images", 3}, {"videos", 3}}).starts_with("videos[0].images: stands beside videos"));
  nlohmann::ordered_json beside = RecipeFolder::recipe();
  beside["images"] = 3;
  CHECK(folder.error(beside).starts_with("images: stands beside videos"));
  beside.erase("videos");
  beside["images"] = "ten";
  CHECK(folder.error(beside).starts_with("images: "));
  CHECK(error({{"images", 3}, {"frames", 3}}).starts_with("videos[0].frames: is of videos"));
  CHECK(error({{"videos", 3}, {"per_image", 2}}).starts_with("videos[0].per_image: is of images"));
  CHECK(error({{"images", 3}, {"per_image", -1}}).starts_with("videos[0].per_image: must lie between 0 and 100"));
  CHECK(error({{"images", 3}, {"placement", "sea"}}).starts_with("videos[0].placement: is \"sea\""));
  CHECK(error({{"images", 3}, {"camera", {{"attitude_deg.pitch", 100}}}})
            .starts_with("videos[0].camera.attitude_deg.pitch: must lie between"));
  CHECK(with("distance_m", 100).starts_with("videos[0].flights[0].size_px: stands beside distance_m"));
  CHECK(with("climb_deg", 5).starts_with("videos[0].flights[0].climb_deg: needs course_deg"));
  nlohmann::ordered_json both = place;
  both["course_deg"] = 5;
  both["direction_deg"] = 5;
  CHECK(error({{"images", 3}, {"flights", {both}}}).starts_with("videos[0].flights[0].course_deg: stands beside"));
}

TEST_CASE("videos of one frame that share what they opened have the bytes of exports of their own") {
  TinyPlan tiny(5, 6);
  int first = 4;
  for (PlannedVideo& video : tiny.plan.videos) {
    video.project.footage.first_frame = first;
    video.project.footage.last_frame = first--;
    video.project.output.codec = VideoCodec::png;
  }
  const DatasetReport report = made(tiny.plan, {.folder = tiny.out(), .source = synthetic_source(), .jobs = 2});
  CHECK(report.exported == 5);
  for (const PlannedVideo& video : tiny.plan.videos) {
    CAPTURE(video.name);
    ExportRequest alone{.project = video.project, .folder = tiny.out("alone")};
    REQUIRE(export_project(alone, {}));
    const VideoEntry entry = read_entry(tiny.out() / video.name / kEntryName).value();
    REQUIRE_FALSE(entry.files.empty());
    for (const DatasetFile& file : entry.files)
      CHECK_MESSAGE(text_of(tiny.out() / video.name / file.path) == text_of(tiny.out("alone") / file.path), file.path);
  }
}
