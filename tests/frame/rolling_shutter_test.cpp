// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "frame/synthetic_scenes.h"
#include "scene/scene_at.h"

namespace sigs::test {
namespace {

constexpr double kReadout_s = 0.02;

// Turns by 60 deg/s and shakes with 20 Hz: within a readout by 1.2 degrees of yaw, 6 px.
std::vector<PlatformAttitude> wild_turns() {
  std::vector<PlatformAttitude> turns;
  for (int i = -100; i <= 300; ++i) {
    const double t = i * 1e-3;
    const Attitude attitude{0.02 * std::sin(125 * t), 0.015 * std::cos(125 * t), t * 60 * 3.14159265358979 / 180};
    turns.push_back({t, rotation_of(attitude)});
  }
  return turns;
}

Scene scene_of(double readout_s, const glm::dvec3& at_m, cv::Size size_px = {320, 240}) {
  Scenario scenario(size_px);
  add_aircraft(scenario, at_m);
  Scene scene = scenario.opened();
  scene.motion.attitudes = wild_turns();
  scene.motion.readout_s = readout_s;
  scene.compositing.supersampling = 8;  // edges fall differently among the samples of two renderings
  return scene;
}

// The coverage of the whole image by the intruder at one moment, all rows at once.
cv::Mat coverage_at(Scene scene, double time_s, ComposeContext& context) {
  scene.motion.readout_s = 0;
  scene.footage.times_s = {time_s};
  const SceneMoment moment = scene_at(scene, 0);
  const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders[0], context, stated_color());
  REQUIRE(layers.has_value());
  cv::Mat image = cv::Mat::zeros(scene.footage.size_px, CV_32FC1);
  const cv::Rect inside = layers->warped.rect & cv::Rect({0, 0}, scene.footage.size_px);
  if (!inside.empty()) layers->warped.coverage(inside - layers->warped.rect.tl()).copyTo(image(inside));
  return image;
}

// Row after row, each from an image of its own at the row's time.
cv::Mat coverage_by_rows(const Scene& scene, double time_s, double readout_s) {
  ComposeContext context;
  const int rows = scene.footage.size_px.height;
  cv::Mat image = cv::Mat::zeros(scene.footage.size_px, CV_32FC1);
  for (int y = 0; y < rows; ++y) {
    const double row_s = time_s + readout_s * (double(y) / (rows - 1) - 0.5);
    coverage_at(scene, row_s, context).row(y).copyTo(image.row(y));
  }
  return image;
}

glm::dvec2 centroid(const cv::Mat& coverage) {
  const cv::Moments sums = cv::moments(coverage);
  return {sums.m10 / sums.m00, sums.m01 / sums.m00};
}

}  // namespace

TEST_CASE("a rolling shutter's image is made of rows, each of its own time") {
  const Scene scene = scene_of(kReadout_s, {60, 6, -152});
  ComposeContext context;
  const SceneMoment moment = scene_at(scene, 1);
  const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders[0], context, stated_color());
  REQUIRE(layers.has_value());
  cv::Mat rolled = cv::Mat::zeros(scene.footage.size_px, CV_32FC1);
  const cv::Rect inside = layers->warped.rect & cv::Rect({0, 0}, scene.footage.size_px);
  REQUIRE(!inside.empty());
  layers->warped.coverage(inside - layers->warped.rect.tl()).copyTo(rolled(inside));

  const cv::Mat by_rows = coverage_by_rows(scene, moment.time_s, kReadout_s);
  const cv::Mat at_once = coverage_at(scene, moment.time_s, context);
  const double area_px = cv::sum(by_rows)[0];
  REQUIRE(area_px > 200);
  // What is left is how edges fall among the 8 x 8 samples of a pixel in two renderings.
  CHECK(cv::norm(rolled, by_rows, cv::NORM_L1) < 0.03 * area_px);
  CHECK(glm::distance(centroid(rolled), centroid(by_rows)) < 0.01);
  CHECK(cv::norm(at_once, by_rows, cv::NORM_L1) > 0.2 * area_px);
}

TEST_CASE("the silhouette of a rolling shutter bounds the rows' pixels, and a fast shutter has that of no shutter") {
  for (const double readout_s : {kReadout_s, 1e-9}) {
    const Scene scene = scene_of(readout_s, {60, 6, -152});
    ComposeContext context;
    const ComposedFrame frame = composed(scene, 1, grainy_frame(scene.footage.size_px, 1));
    const IntruderTruth& truth = frame.truth.intruders.at(0);
    REQUIRE(truth.amodal_box);
    REQUIRE(truth.visible_box);
    cv::Mat mask = coverage_by_rows(scene, 0.04, readout_s) > 1 / 64.0;
    const cv::Rect box = box_of(mask);
    CHECK(std::abs(truth.amodal_box->x + 0.5 - box.x) < 1.1);
    CHECK(std::abs(truth.amodal_box->y + 0.5 - box.y) < 1.1);
    CHECK(std::abs(truth.amodal_box->x + truth.amodal_box->width + 0.5 - box.br().x) < 1.1);
    CHECK(std::abs(truth.amodal_box->y + truth.amodal_box->height + 0.5 - box.br().y) < 1.1);
    CHECK(std::abs(truth.visible_box->x - box.x) <= 1);
    CHECK(std::abs(truth.visible_box->y - box.y) <= 1);
  }
}

TEST_CASE("across the image's border a rolling shutter sees the share of the rows' pixels that lie inside") {
  for (const double side_m : {33.0, 35.0, 37.0}) {
    CAPTURE(side_m);
    const glm::dvec3 at_m(60, side_m, -152);
    const Scene scene = scene_of(kReadout_s, at_m);
    const ComposedFrame frame = composed(scene, 1, grainy_frame(scene.footage.size_px, 1));
    // The same camera with 320 columns more on each side.
    const cv::Mat by_rows = coverage_by_rows(scene_of(kReadout_s, at_m, {960, 240}), 0.04, kReadout_s);
    const double share = cv::sum(by_rows.colRange(320, 640))[0] / cv::sum(by_rows)[0];
    REQUIRE(share > 0.1);
    REQUIRE(share < 0.9);
    CHECK(frame.truth.intruders[0].inside_fraction == doctest::Approx(share).epsilon(0.03));
    CHECK(frame.truth.intruders[0].visible_fraction == doctest::Approx(share).epsilon(0.03));
  }
}

TEST_CASE("a readout of 0 changes no byte, and a camera that does not move sees the same with any readout") {
  Scenario scenario;
  add_aircraft(scenario, {60, 6, -152});
  Scene scene = scenario.opened();
  const Frame background = grainy_frame(scene.footage.size_px, 1);
  const ComposedFrame at_once = composed(scene, 1, background);
  scene.motion.readout_s = 0.05;
  const ComposedFrame rolled = composed(scene, 1, background);
  cv::Mat difference;
  cv::absdiff(at_once.image.planes[0], rolled.image.planes[0], difference);
  double largest = 0;
  cv::minMaxIdx(difference, nullptr, &largest);
  CHECK(largest <= 1);  // rays of unit length round otherwise
  CHECK(at_once.truth.intruders[0].visible_box == rolled.truth.intruders[0].visible_box);
}

TEST_CASE("a rolling shutter bends turning blades: each row sees them at its own time") {
  Mesh disc;
  disc.materials.push_back({.name = "disc", .rotor = Rotor{.blade_count = 2, .tip_m = 6, .rpm = 400}});
  disc.materials[0].rotor->axis = {-1, 0, 0};
  disc.materials[0].rotor->across = {0, 1, 0};
  for (const glm::vec3 corner : {glm::vec3(0, -6, 6), glm::vec3(0, 6, 6), glm::vec3(0, 6, -6), glm::vec3(0, -6, -6)})
    disc.vertices.push_back({corner, {-1, 0, 0}, {0, 0}});
  disc.indices = {0, 1, 2, 0, 2, 3};
  disc.parts = {{0, 0, 6}};
  disc.low_m = {0, -6, -6};
  disc.high_m = {0, 6, 6};
  disc.radius_m = 8.5F;
  const auto model = std::make_shared<const Model>(model_of(std::move(disc)));
  Model turned = *model;
  Scenario scenario;
  add_aircraft(scenario, {60, 6, -152});
  Scene scene = scenario.opened();
  scene.models = {model};
  scene.intruders[0].model = model.get();
  scene.motion.readout_s = kReadout_s;
  ComposeContext context;
  const auto opacity_in = [&](const Scene& it) {
    const SceneMoment moment = scene_at(it, 1);
    const Result<IntruderLayers> layers = intruder_layers(it, moment, moment.intruders[0], context, stated_color());
    REQUIRE(layers.has_value());
    cv::Mat opacity;
    cv::extractChannel(layers->warped.color, opacity, 3);
    cv::Mat image = cv::Mat::zeros(it.footage.size_px, CV_32FC1);
    const cv::Rect inside = layers->warped.rect & cv::Rect({0, 0}, it.footage.size_px);
    REQUIRE(!inside.empty());
    opacity(inside - layers->warped.rect.tl()).copyTo(image(inside));
    return image;
  };
  const cv::Mat rolled = opacity_in(scene);
  // The same rows of a shutter that opens all at once, with blades turned on by the row's time.
  cv::Mat by_rows = cv::Mat::zeros(rolled.size(), CV_32FC1);
  const int rows = rolled.rows;
  for (int y = 0; y < rows; ++y) {
    if (cv::countNonZero(rolled.row(y)) == 0) continue;
    turned.mesh.materials[0].rotor->phase_rad =
        2 * 3.14159265358979 * 400 / 60 * kReadout_s * (double(y) / (rows - 1) - 0.5);
    Scene at_once = scene;
    at_once.motion.readout_s = 0;
    at_once.intruders[0].model = &turned;
    opacity_in(at_once).row(y).copyTo(by_rows.row(y));
  }
  const double area_px = cv::sum(by_rows)[0];
  REQUIRE(area_px > 20);
  // What is left is that blades' edges are sampled in two renderings.
  CHECK(cv::norm(rolled, by_rows, cv::NORM_L1) < 0.05 * area_px);
  Scene at_once = scene;
  at_once.motion.readout_s = 0;
  CHECK(cv::norm(opacity_in(at_once), by_rows, cv::NORM_L1) > 0.2 * area_px);
}

TEST_CASE(
    "an intruder that is cut off by the image's edge, and one in the camera's way, pass through a rolling shutter") {
  for (const glm::dvec3& at_m : {glm::dvec3(60, -38, -150), glm::dvec3(8, 0, -150), glm::dvec3(0, 0, -150),
                                 glm::dvec3(-60, 0, -150), glm::dvec3(1e7, 0, -150)}) {
    const Scene scene = scene_of(kReadout_s, at_m);
    const ComposedFrame frame = composed(scene, 1, grainy_frame(scene.footage.size_px, 1));
    CHECK(frame.truth.intruders[0].visible_fraction >= 0);
    CHECK(frame.truth.intruders[0].visible_fraction <= 1);
  }
}

}  // namespace sigs::test
