// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <vector>

#include "extremes/validity.h"

namespace sigs::test {
namespace {

constexpr double kAmbient = 0.25;

// A white cube of 10 m that shows us one face, 60 m ahead.
Scene cube_lit_from(const glm::dvec3& light_from_eye_m, const glm::dvec3& color = {1, 1, 1}) {
  Scenario scenario;
  add_cube(scenario, 10, kEye_m + glm::dvec3(60, 0, 0));
  scenario.project.light = {.position_m = kEye_m + light_from_eye_m, .color = color, .ambient = kAmbient};
  return scenario.opened();
}

ValidFrame composed_frame(const Scene& scene) {
  return valid_frame(scene, 1, even_frame(scene.footage.size_px, 100));
}

// Light that the middle of the face sends to us, where it is opaque.
cv::Vec4f face_of(const ValidFrame& valid) {
  const Layer& layer = valid.layers[0].occluded;
  REQUIRE(!layer.empty());
  const cv::Vec4f color = layer.color.at<cv::Vec4f>(cv::Point(160, 120) - layer.rect.tl());
  REQUIRE(color[3] == doctest::Approx(1).epsilon(1e-4));
  return color;
}

}  // namespace

TEST_CASE("with a light inside the model its outside has ambient light alone") {
  for (const glm::dvec3& inside_m : {glm::dvec3(60, 0, 0), glm::dvec3(55.001, 0, 0), glm::dvec3(64, 4, -4)})
    CHECK(face_of(composed_frame(cube_lit_from(inside_m)))[0] == doctest::Approx(kAmbient).epsilon(1e-4));
}

TEST_CASE("with a light behind the model the visible face has ambient light alone") {
  for (const double behind_m : {70.0, 1e3, 9e11})
    CHECK(face_of(composed_frame(cube_lit_from({behind_m, 0, 0})))[0] == doctest::Approx(kAmbient).epsilon(1e-4));
}

TEST_CASE("a light behind the camera or at it or just before the face lights it in full") {
  for (const double ahead_m : {-9e11, -1e3, 0.0, 40.0})
    CHECK(face_of(composed_frame(cube_lit_from({ahead_m, 0, 0})))[0] == doctest::Approx(1).epsilon(0.002));
}

TEST_CASE("a light a billion kilometres away lights as its direction says") {
  for (const glm::dvec3& direction : {glm::dvec3(-1, 0, 0), glm::dvec3(-3, 4, 0), glm::dvec3(-0.6, -0.48, 0.64)}) {
    const double facing = -normalize(direction).x;
    const double wanted = kAmbient + (1 - kAmbient) * facing;
    CHECK(face_of(composed_frame(cube_lit_from(direction * 1e11)))[0] == doctest::Approx(wanted).epsilon(1e-4));
    CHECK(face_of(composed_frame(cube_lit_from(direction * 1e11)))[0] ==
          doctest::Approx(face_of(composed_frame(cube_lit_from(direction * 1e9)))[0]).epsilon(1e-5));
  }
  CHECK(face_of(composed_frame(cube_lit_from({-9e11, 9e11, -9e11})))[0] > kAmbient);
}

TEST_CASE("a light on the face or an edge or a corner or the reference point of the model makes no NaN") {
  for (const glm::dvec3& place : {glm::dvec3(55, 0, 0), glm::dvec3(55, 5, 0), glm::dvec3(55, 5, 5),
                                  glm::dvec3(60, 0, 0), glm::dvec3(55 - 1e-9, 0, 0)}) {
    const cv::Vec4f face = face_of(composed_frame(cube_lit_from(place)));
    CHECK(face[0] >= kAmbient * (1 - 1e-4));
    CHECK(face[0] <= 1.001);
  }
}

TEST_CASE("no light and a light a hundred times too strong stay within the image's range") {
  CHECK(face_of(composed_frame(cube_lit_from({-100, 0, 0}, {0, 0, 0})))[0] == 0);
  const ValidFrame strong = composed_frame(cube_lit_from({-100, 0, 0}, {100, 100, 100}));
  CHECK(face_of(strong)[0] == doctest::Approx(100).epsilon(0.01));
  CHECK(strong.composed.image.planes[0].at<uchar>(120, 160) >= 235);
}

}  // namespace sigs::test
