// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>

#include "base/transfer.h"
#include "render/scenes.h"

namespace sigs {

using namespace test;

namespace {

// 24 bits of a float, and a few operations on it.
constexpr double kShadingRounding = 2e-6;

cv::Vec4f color_in_middle(const Mesh& mesh, const Light& light, double distance_m = 10) {
  const Layer layer = drawn(mesh, at({distance_m, 0, 0}), light, view_of({9, 9}, 100));
  CHECK(is_valid(layer));
  return layer.color.at<cv::Vec4f>(4, 4);
}

Mesh wall(const Material& material) {
  return facing_quad({-2, -2}, {2, 2}, material);
}

bool is_near(const cv::Vec4f& a, const glm::dvec4& b, double tolerance = kShadingRounding) {
  for (int i = 0; i < 4; ++i)
    if (!(std::abs(a[i] - b[i]) <= tolerance)) return false;
  return true;
}

double linear(float display) {
  return linear_of_display(display);
}

}  // namespace

TEST_CASE("ambient light alone gives albedo times ambient in linear light") {
  for (const double ambient : {0.0, 0.35, 1.0}) {
    const Light light{.p_in_camera = {100, 0, 0}, .color = {1, 0.5, 0.25}, .ambient = ambient};  // behind the wall
    const cv::Vec4f color = color_in_middle(wall(paint({0.2F, 0.5F, 1})), light);
    CHECK(is_near(color, {linear(0.2F) * ambient, linear(0.5F) * ambient * 0.5, ambient * 0.25, 1}));
  }
}

TEST_CASE("a white surface that faces the light is white") {
  const cv::Vec4f color = color_in_middle(wall(paint({1, 1, 1})), {.p_in_camera = {0, 0, 0}, .ambient = 0.35});
  CHECK(is_near(color, {1, 1, 1, 1}));
}

TEST_CASE("a matt surface follows the cosine of the light's angle") {
  for (const double angle_deg : {0.0, 30.0, 60.0, 85.0, 95.0}) {
    const double angle = angle_deg * M_PI / 180;
    // 1 km from the surface's middle, which is 10 m ahead.
    const Light light{.p_in_camera = glm::dvec3{10, 0, 0} + 1000.0 * glm::dvec3{-std::cos(angle), std::sin(angle), 0},
                      .ambient = 0.2};
    const double expected = 0.2 + 0.8 * std::max(0.0, std::cos(angle));
    CHECK(is_near(color_in_middle(wall(paint({1, 1, 1})), light), {expected, expected, expected, 1}, 1e-5));
  }
}

TEST_CASE("light from the right lights the right side") {
  const Mesh mesh = box({1, 1, 1}, paint({1, 1, 1}));
  Pose<frame::Camera, frame::Body> pose = at({10, 0, 0});
  pose.rotation = glm::angleAxis(M_PI / 4, glm::dvec3{0, 0, 1});  // an edge towards the eye, a face either side
  const Layer layer = drawn(mesh, pose, {.p_in_camera = {10, 1000, 0}, .ambient = 0.1}, view_of({41, 41}, 100));
  const float left = layer.color.at<cv::Vec4f>(20, 14)[0];
  const float right = layer.color.at<cv::Vec4f>(20, 26)[0];
  CHECK(left == doctest::Approx(0.1).epsilon(1e-5));
  CHECK(right ==
        doctest::Approx(0.1 + 0.9 * std::cos(M_PI / 4)).epsilon(1e-3));  // the light is 1000 m, not infinitely, far
}

TEST_CASE("light from above lights the top") {
  const Mesh mesh = box({1, 1, 1}, paint({1, 1, 1}));
  Pose<frame::Camera, frame::Body> pose = at({10, 0, 0});
  pose.rotation = glm::angleAxis(M_PI / 4, glm::dvec3{0, 1, 0});
  const Layer layer = drawn(mesh, pose, {.p_in_camera = {10, 0, -1000}, .ambient = 0.1}, view_of({41, 41}, 100));
  CHECK(layer.color.at<cv::Vec4f>(14, 20)[0] > 0.7F);
  CHECK(layer.color.at<cv::Vec4f>(26, 20)[0] < 0.11F);
}

TEST_CASE("a thin surface is lit on the side that faces the eye") {
  // Seen from its back: the light behind the eye lights it, the light beyond it does not.
  Mesh mesh;
  mesh.materials = {paint({1, 1, 1})};
  add_quad(mesh, {0, -2, -2}, {0, 4, 0}, {0, 0, 4}, 0);  // the normal points away from the eye
  mesh = measured(std::move(mesh));
  CHECK(color_in_middle(mesh, {.p_in_camera = {-1000, 0, 0}, .ambient = 0.1})[0] == doctest::Approx(1));
  CHECK(color_in_middle(mesh, {.p_in_camera = {1000, 0, 0}, .ambient = 0.1})[0] == doctest::Approx(0.1));
}

TEST_CASE("gloss brightens the mirror direction only and not what lies in shadow") {
  Material glossy = paint({0, 0, 0});
  glossy.specular = {1, 0.5F, 0};
  glossy.shininess = 50;
  const Light head_on{.p_in_camera = {0, 0, 0}, .ambient = 0.2};
  CHECK(is_near(color_in_middle(wall(glossy), head_on), {0.25 * 0.8, 0.125 * 0.8, 0, 1}));
  const Light aside{.p_in_camera = {0, 10, 0}, .ambient = 0.2};
  const double expected = 0.25 * 0.8 * std::pow(std::cos(M_PI / 8), 50);  // half of 45 degrees
  CHECK(is_near(color_in_middle(wall(glossy), aside), {expected, expected / 2, 0, 1}, 1e-5));
  const Light behind{.p_in_camera = {20, 0, 0}, .ambient = 0.2};
  CHECK(is_near(color_in_middle(wall(glossy), behind), {0, 0, 0, 1}));
}

TEST_CASE("a light on the surface, within the body or very far away gives no NaN") {
  Material glossy = paint({1, 1, 1});
  glossy.specular = {1, 1, 1};
  const Mesh mesh = box({1, 1, 1}, glossy);
  for (const glm::dvec3 place : {glm::dvec3{10, 0, 0}, glm::dvec3{9, 0, 0}, glm::dvec3{9, 1, 1}, glm::dvec3{0, 0, 0},
                                 glm::dvec3{1e12, 0, 0}, glm::dvec3{-1e300, 1e300, 0}}) {
    const Layer layer = drawn(mesh, at({10, 0, 0}), {.p_in_camera = place}, view_of({33, 33}, 100));
    CHECK(is_valid(layer));
    // The eye at a corner of the body, and the light with it.
    CHECK(is_valid(drawn(mesh, at({1, 1, 1}), {.p_in_camera = place}, view_of({33, 33}, 10))));
  }
}

TEST_CASE("a light very far away acts by its direction") {
  const double far_m = 1.5e11;
  const Light light{.p_in_camera = {-far_m, far_m, 0}, .ambient = 0};
  CHECK(color_in_middle(wall(paint({1, 1, 1})), light)[0] == doctest::Approx(std::sqrt(0.5)).epsilon(1e-5));
}

TEST_CASE("normals without length and unusual material numbers give no NaN") {
  Material odd = paint({1, 1, 1});
  odd.specular = {1, 1, 1};
  odd.shininess = 0;
  Mesh mesh = wall(odd);
  for (Vertex& vertex : mesh.vertices) vertex.normal = {0, 0, 0};
  CHECK(is_valid(drawn(mesh, at({10, 0, 0}), Light{}, view_of({9, 9}, 100))));
}

}  // namespace sigs
