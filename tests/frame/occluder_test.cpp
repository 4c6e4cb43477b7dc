// SPDX-License-Identifier: MIT
#include "frame/composite.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "frame/synthetic_scenes.h"
#include "scene/opened_project.h"

namespace sigs::test {
namespace {

const cv::Size kImage_px(320, 240);

Camera pinhole() {
  return {*Lens::make({.fx = 300, .fy = 300, .cx = 159.5, .cy = 119.5}), kImage_px};
}

Pose<frame::World, frame::Camera> camera_pose(const glm::dvec3& position_m, const Attitude& attitude = {}) {
  return {rotation_of(attitude), position_m};
}

// White from this column on.
cv::Mat white_from(int column) {
  cv::Mat mask = cv::Mat::zeros(kImage_px, CV_32FC1);
  mask.colRange(column, mask.cols).setTo(1);
  return mask;
}

// Where a row of the mask rises through one half, px.
double edge_of(const cv::Mat& row) {
  for (int x = 1; x < row.cols; ++x) {
    const float before = row.at<float>(0, x - 1);
    const float here = row.at<float>(0, x);
    if (before < 0.5F && here >= 0.5F) return x - 1 + (0.5 - before) / (here - before);
  }
  return -1;
}

double edge_seen_from(const Pose<frame::World, frame::Camera>& pose, const Occluder& occluder) {
  LensTable lens(pinhole());
  return edge_of(occluder_seen_from(pose, occluder, lens, {0, 119, kImage_px.width, 2}).row(0));
}

// A plate before the axis at 200 m that covers columns and rows 144 to 175, 104 to 135 but for their outermost halves.
void add_plate_at_200(Scenario& scenario) {
  constexpr double kHalf_m = 15.5 * 200 / 300;
  write_obj(scenario.path("plate.obj"), {{{-1e-4, -kHalf_m, -kHalf_m}, {1e-4, kHalf_m, kHalf_m}}}, 1);
  scenario.add("plate.obj", {200, 0, -150});
}

ComposedFrame with_occluder(Scenario& scenario, int column, double distance_m, int frame = 1) {
  cv::Mat mask;
  white_from(column).convertTo(mask, CV_8U, 255);
  cv::imwrite(scenario.path("trees.png").string(), mask);
  scenario.project.footage.occluder_mask = "trees.png";
  scenario.project.footage.occluder_distance_m = distance_m;
  return composed(scenario.opened(), frame, grainy_frame(kImage_px, 1));
}

}  // namespace

TEST_CASE("from its own pose an occluder is its mask") {
  const Occluder occluder{.mask = white_from(160), .world_from_camera = camera_pose({0, 0, -150}), .distance_m = 100};
  LensTable lens(pinhole());
  const cv::Rect rect(100, 50, 120, 80);
  CHECK(same_bytes(occluder_seen_from(camera_pose({0, 0, -150}), occluder, lens, rect), occluder.mask(rect)));
}

TEST_CASE("an occluder stays in the world while the camera turns") {
  const Occluder occluder{.mask = white_from(160), .world_from_camera = camera_pose({0, 0, -150})};
  // Its edge lies half a pixel left of column 160: on the axis, but for rounding.
  for (const double yaw : {-0.2, -0.01, 0.05, 0.3})
    CHECK(edge_seen_from(camera_pose({5, 5, -100}, {0, 0, yaw}), occluder) ==
          doctest::Approx(159.5 - 300 * std::tan(yaw)).epsilon(1e-3));
}

TEST_CASE("an occluder at a known distance moves by its parallax") {
  const Occluder occluder{.mask = white_from(160), .world_from_camera = camera_pose({0, 0, -150}), .distance_m = 100};
  // A point 100 m ahead on the axis, seen from 10 m to the right: 30 px to the left.
  CHECK(edge_seen_from(camera_pose({0, 10, -150}), occluder) == doctest::Approx(159.5 - 30).epsilon(2e-3));
  // Flying towards it does not move the axis; an edge elsewhere moves outward.
  CHECK(edge_seen_from(camera_pose({50, 0, -150}), occluder) == doctest::Approx(159.5).epsilon(1e-3));
  Occluder right = occluder;
  right.mask = white_from(220);  // tangent 0.2, at 98.06 m ahead and 19.61 m to the right
  CHECK(edge_seen_from(camera_pose({50, 0, -150}), right) ==
        doctest::Approx(159.5 + 300 * 19.612 / 48.058).epsilon(2e-3));
  // Beyond it nothing is hidden.
  CHECK(edge_seen_from(camera_pose({150, 0, -150}), occluder) == -1);
}

TEST_CASE("an occluder hides what is farther away, in image and truth, and leaves what is nearer") {
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain}) {
    CAPTURE(static_cast<int>(method));
    Scenario free;
    free.project.compositing.method = method;
    add_plate_at_200(free);
    const int right_edge = composed(free).truth.intruders.at(0).visible_box->br().x;  // the paper's key is harder
    for (const double distance_m : {0.0, 150.0, 250.0}) {
      Scenario scenario;
      scenario.project.compositing.method = method;
      add_plate_at_200(scenario);
      const ComposedFrame frame = with_occluder(scenario, 160, distance_m);
      const IntruderTruth& truth = frame.truth.intruders.at(0);
      const bool is_behind = distance_m < 200;
      CHECK(truth.visible_fraction == doctest::Approx(is_behind ? 16.0 / 31 : 1.0).epsilon(0.02));
      REQUIRE(truth.visible_box);
      CHECK(truth.visible_box->x == 144);
      CHECK(truth.visible_box->br().x == (is_behind ? 160 : right_edge));
      CHECK(box_of(frame.mask).br().x == (is_behind ? 160 : right_edge));
      CHECK(truth.amodal_box->width == doctest::Approx(31).epsilon(1e-4));
    }
  }
}

TEST_CASE("an occluder's frame lies in the footage, and its mask has the footage's size") {
  Scenario scenario;
  add_plate_at_200(scenario);
  cv::imwrite(scenario.path("trees.png").string(), cv::Mat::zeros(10, 10, CV_8UC1));
  scenario.project.footage.occluder_mask = "trees.png";
  const auto opened = [&] { return open_scene(scenario.project, {.size_px = kImage_px, .times_s = {0, 0.04, 0.08}}); };
  REQUIRE_FALSE(opened());
  CHECK(opened().error().text().find("footage.occluder_mask") != std::string::npos);
  cv::imwrite(scenario.path("trees.png").string(), cv::Mat::zeros(kImage_px, CV_8UC1));
  scenario.project.footage.occluder_frame = 3;
  REQUIRE_FALSE(opened());
  CHECK(opened().error().text().find("footage.occluder_frame: the footage has 3 frames, 0 to 2") != std::string::npos);
}

}  // namespace sigs::test
