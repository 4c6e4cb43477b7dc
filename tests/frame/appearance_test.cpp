// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

constexpr glm::dvec3 kRed(1, 0.02, 0.02);
constexpr glm::dvec3 kBlue(0.02, 0.02, 1);

double mean_luma(const ComposedFrame& frame, const cv::Rect& where) {
  return cv::mean(frame.image.planes[0](where), frame.mask(where) == 255)[0];
}

// A sphere in the middle of the image under one light; the ratio of two opposite sides' luma.
ComposedFrame lit_from(const glm::dvec3& light_m) {
  Scenario scenario;
  write_sphere_obj(scenario.path("ball.obj"), 5);
  scenario.add("ball.obj", {40, 0, -150});
  scenario.project.light = {.position_m = light_m, .color = {1, 1, 1}, .ambient = 0.1};
  return composed(scenario.opened(), 1, even_frame(scenario.size_px(), 30));
}

const cv::Rect kLeft(0, 0, 150, 240), kRight(170, 0, 150, 240), kUpper(0, 0, 320, 110), kLower(0, 130, 320, 110);

// An aircraft of two colours, level, without shading.
ComposedFrame painted(const std::vector<Block>& blocks, const std::vector<WaypointSettings>& waypoints) {
  Scenario scenario;
  write_obj(scenario.path("painted.obj"), blocks, 1);
  scenario.add("painted.obj", {}).trajectory.waypoints = waypoints;
  scenario.project.light.ambient = 1;
  return composed(scenario.opened(), 1, even_frame(scenario.size_px(), 126, PixelLayout::yuv444));
}

// Centroid of the pixels with more of one colour than gray: plane 1 blue, plane 2 red.
cv::Point2d middle_of(const ComposedFrame& frame, std::size_t plane) {
  cv::Mat strong = frame.image.planes[plane] > 170;
  const cv::Moments m = cv::moments(strong, true);
  REQUIRE(m.m00 > 20);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

const std::vector<Block> kNoseAndTail{{{0, -1, -1}, {7, 1, 1}, kRed}, {{-7, -1, -1}, {0, 1, 1}, kBlue}};
const std::vector<Block> kTopAndBelly{{{-5, -1, -2}, {5, 1, 0}, kRed}, {{-5, -1, 0}, {5, 1, 2}, kBlue}};
const std::vector<Block> kRightAndLeft{{{-1, 0, -0.5}, {1, 9, 0.5}, kRed}, {{-1, -9, -0.5}, {1, 0, 0.5}, kBlue}};

std::vector<WaypointSettings> along(const glm::dvec3& step_m) {
  const glm::dvec3 middle(70, 0, -150);
  return {{.frame = 0, .position_m = middle - step_m}, {.frame = 2, .position_m = middle + step_m}};
}

}  // namespace

TEST_CASE("light from one side makes that side brighter") {
  const ComposedFrame right = lit_from({40, 3000, -150});
  CHECK(mean_luma(right, kRight) > 1.5 * mean_luma(right, kLeft));
  const ComposedFrame left = lit_from({40, -3000, -150});
  CHECK(mean_luma(left, kLeft) > 1.5 * mean_luma(left, kRight));
  const ComposedFrame above = lit_from({40, 0, -3000});
  CHECK(mean_luma(above, kUpper) > 1.5 * mean_luma(above, kLower));
  const ComposedFrame below = lit_from({40, 0, 3000});
  CHECK(mean_luma(below, kLower) > 1.5 * mean_luma(below, kUpper));
}

TEST_CASE("light is fixed in the world and not to the camera") {
  // The camera looks the other way and lies on its side; the ball is lit from world Y, which is on the camera's left.
  Scenario scenario;
  write_sphere_obj(scenario.path("ball.obj"), 5);
  scenario.add("ball.obj", {-40, 0, -150});
  scenario.project.camera.yaw_deg = 180;
  scenario.project.light = {.position_m = {-40, 3000, -150}, .color = {1, 1, 1}, .ambient = 0.1};
  const ComposedFrame turned = composed(scenario.opened(), 1, even_frame(scenario.size_px(), 30));
  CHECK(mean_luma(turned, kLeft) > 1.5 * mean_luma(turned, kRight));
}

TEST_CASE("the nose leads in the direction of flight") {
  const ComposedFrame to_right = painted(kNoseAndTail, along({0, 2, 0}));
  CHECK(middle_of(to_right, 2).x > middle_of(to_right, 1).x + 10);
  const ComposedFrame to_left = painted(kNoseAndTail, along({0, -2, 0}));
  CHECK(middle_of(to_left, 2).x < middle_of(to_left, 1).x - 10);
  const ComposedFrame climbing = painted(kNoseAndTail, along({0, 0.5, -2}));
  CHECK(middle_of(climbing, 2).y < middle_of(climbing, 1).y - 10);
}

TEST_CASE("up on the aircraft is up in the image") {
  for (const glm::dvec3& step :
       {glm::dvec3(0, 2, 0), glm::dvec3(0, -2, 0), glm::dvec3(2, 0, 0), glm::dvec3(-2, 0, 0)}) {
    const ComposedFrame frame = painted(kTopAndBelly, along(step));
    CHECK(middle_of(frame, 2).y < middle_of(frame, 1).y - 5);
  }
}

TEST_CASE("the right wing is on the right of an aircraft that flies away and on the left of one that comes") {
  const ComposedFrame away = painted(kRightAndLeft, along({2, 0, 0}));
  CHECK(middle_of(away, 2).x > middle_of(away, 1).x + 10);
  const ComposedFrame coming = painted(kRightAndLeft, along({-2, 0, 0}));
  CHECK(middle_of(coming, 2).x < middle_of(coming, 1).x - 10);
}

TEST_CASE("an aircraft that turns right has its right wing low") {
  // 80 m/s away from the camera on a circle of some 400 m to the right: a bank of about 58 degrees.
  std::vector<WaypointSettings> turn;
  for (int i = -2; i <= 2; ++i) {
    const double angle = 0.2 * i;
    turn.push_back(
        {.frame = 25.0 * i + 1, .position_m = {100 + 400 * std::sin(angle), 400 * (1 - std::cos(angle)), -150}});
  }
  const ComposedFrame frame = painted(kRightAndLeft, turn);
  CHECK(attitude_of(frame.truth.intruders.front().world_from_body).roll_rad > 0.5);
  CHECK(middle_of(frame, 2).y > middle_of(frame, 1).y + 8);
}

TEST_CASE("a camera that rolls right sees the horizon turn left") {
  Scenario scenario;
  write_obj(scenario.path("painted.obj"), kTopAndBelly, 1);
  scenario.add("painted.obj", {}).trajectory.waypoints = along({2, 0, 0});
  scenario.project.light.ambient = 1;
  scenario.project.camera.roll_deg = 90;
  const ComposedFrame frame = composed(scenario.opened(), 1, even_frame(scenario.size_px(), 126, PixelLayout::yuv444));
  // With its right side down, what is up in the world is on the image's left.
  CHECK(middle_of(frame, 2).x < middle_of(frame, 1).x - 5);
}

}  // namespace sigs::test
