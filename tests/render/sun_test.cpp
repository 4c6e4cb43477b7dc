// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "render/scenes.h"

namespace sigs {

using namespace test;

namespace {

// 24 bits of a float, and some ten operations on it.
constexpr double kSunRounding = 3e-6;

// The sun alone, in the camera's frame: X ahead, Y right, Z down.
Light sun(const glm::dvec3& to_sun) {
  return {.kind = Light::Kind::sun, .to_sun = to_sun};
}

Light sky_and_ground(const glm::dvec3& sky, const glm::dvec3& ground, const glm::dvec3& up = {0, 0, -1}) {
  return {.color = glm::dvec3(0), .kind = Light::Kind::sun, .up = up, .sky_color = sky, .ground_color = ground};
}

Mesh wall_of(const Material& material) {
  return facing_quad({-2, -2}, {2, 2}, material);
}

cv::Vec4f middle_of(const Mesh& mesh, const Light& light, const glm::dquat& turn = {1, 0, 0, 0}) {
  const Layer layer = drawn(mesh, {turn, {10, 0, 0}}, light, view_of({9, 9}, 100));
  CHECK(is_valid(layer));
  return layer.color.at<cv::Vec4f>(4, 4);
}

glm::dvec3 towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = glm::radians(azimuth_deg);
  const double elevation = glm::radians(elevation_deg);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), -std::sin(elevation)};
}

// Schlick's approximation with full reflection at a grazing angle.
double schlick(double straight, double cosine) {
  return straight + (1 - straight) * std::pow(1 - cosine, 5);
}

Material glossy_black(float specular, float shininess) {
  Material material = paint({0, 0, 0});
  material.specular = glm::vec3(specular);
  material.shininess = shininess;
  return material;
}

}  // namespace

TEST_CASE("a white surface squarely in the sun is white, and the exposure multiplies it") {
  Light light = sun({-1, 0, 0});
  for (const double exposure : {1.0, 0.25, 3.0}) {
    light.exposure = exposure;
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(middle_of(wall_of(kWhite), light)[c] - exposure) <= kSunRounding * exposure);
  }
  light.color = {1, 0.5, 0.25};
  CHECK(middle_of(wall_of(kWhite), light)[1] == doctest::Approx(1.5).epsilon(kSunRounding));
}

TEST_CASE("sunlight falls off with the cosine of its angle and is nothing from behind") {
  for (const double angle_deg : {0.0, 30.0, 60.0, 85.0, 89.9, 90.0, 95.0, 180.0}) {
    const double angle = glm::radians(angle_deg);
    const cv::Vec4f color = middle_of(wall_of(kWhite), sun({-std::cos(angle), std::sin(angle), 0}));
    CHECK(std::abs(color[0] - std::max(0.0, std::cos(angle))) < kSunRounding);
  }
}

TEST_CASE("the sun's direction alone matters, not the length of the vector or the distance of the body") {
  const Mesh mesh = wall_of(kWhite);
  const double expected = std::sqrt(0.5);
  for (const double length : {1e-30, 1.0, 1e200}) {
    const Light light = sun(length * glm::dvec3(-1, 1, 0));
    CHECK(middle_of(mesh, light)[0] == doctest::Approx(expected).epsilon(kSunRounding));
    const Layer far = drawn(mesh, at({1e7, 0, 0}), light, view_of({9, 9}, 1e8));
    CHECK(far.color.at<cv::Vec4f>(4, 4)[0] == doctest::Approx(expected).epsilon(kSunRounding));
  }
}

TEST_CASE("sky and ground light a surface by how far it looks up") {
  const glm::dvec3 sky(0.2, 0.3, 0.4);
  const glm::dvec3 ground(0.1, 0.05, 0.02);
  for (const double tilt_deg : {-80.0, -30.0, 0.0, 45.0, 80.0}) {
    // The wall looks at the camera, -X; about Y its upper edge goes away and it looks up.
    const glm::dquat turn = glm::angleAxis(glm::radians(tilt_deg), glm::dvec3(0, -1, 0));
    const double u = std::sin(glm::radians(tilt_deg));
    const cv::Vec4f color = middle_of(wall_of(kWhite), sky_and_ground(sky, ground), turn);
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(color[c] - (sky[c] * (1 + u) / 2 + ground[c] * (1 - u) / 2)) < kSunRounding);
  }
}

TEST_CASE("up turns with the camera") {
  // The camera looks straight up: the zenith is ahead, and the wall, which looks at it, sees the ground alone.
  CHECK(middle_of(wall_of(kWhite), sky_and_ground(glm::dvec3(1), glm::dvec3(0.25), {1, 0, 0}))[0] ==
        doctest::Approx(0.25).epsilon(kSunRounding));
}

TEST_CASE("in even light from everywhere a white body is even, and no paint or glass gives more than it gets") {
  const Light even = sky_and_ground(glm::dvec3(1), glm::dvec3(1));
  for (const double turn_deg : {0.0, 30.0, 70.0}) {
    const glm::dquat turn = glm::angleAxis(glm::radians(turn_deg), glm::dvec3(0, 0, 1));
    CHECK(middle_of(wall_of(kWhite), even, turn)[0] == doctest::Approx(1).epsilon(kSunRounding));
    Material glass = paint({1, 1, 1}, 0.3F);
    glass.specular = glm::vec3(0.6F);
    const cv::Vec4f color = middle_of(wall_of(glass), even, turn);
    CHECK(color[0] <= color[3] + kSunRounding);  // over a background of 1 it stays 1
    CHECK(color[0] == doctest::Approx(color[3]).epsilon(1e-5));
  }
}

TEST_CASE("the highlight is normalised Blinn-Phong with Schlick's Fresnel") {
  const double straight = 0.25 * 0.8;  // a quarter of the MTL's colour
  for (const double shininess : {10.0, 60.0, 150.0})
    for (const double angle_deg : {0.0, 10.0, 20.0, 60.0}) {
      const double angle = glm::radians(angle_deg);
      const double half = angle / 2;  // the eye looks at the wall squarely
      const double expected = std::cos(angle) * schlick(straight, std::cos(half)) * (shininess + 8) / 8 *
                              std::pow(std::cos(half), shininess);
      const cv::Vec4f color = middle_of(wall_of(glossy_black(0.8F, static_cast<float>(shininess))),
                                        sun({-std::cos(angle), std::sin(angle), 0}));
      CHECK(color[0] == doctest::Approx(expected).epsilon(2e-5));  // a power of up to 150 of a float
    }
}

TEST_CASE("a smooth mirror sends back the sun's energy, as much as it reflects squarely") {
  // The sum over all directions that the eye can look from of light times cosine, as an integral over rings; the sun is
  // straight above. Energy that comes in: pi (a white surface sends 1 in each direction, times the integral of the
  // cosine).
  constexpr int kRings = 90;
  for (const double shininess : {20.0, 100.0}) {
    const Mesh mesh = wall_of(glossy_black(0.4F, static_cast<float>(shininess)));
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
      const double angle = (i + 0.5) * M_PI / 2 / kRings;
      const glm::dquat turn = glm::angleAxis(angle, glm::dvec3(0, 0, 1));
      const glm::dvec3 normal = turn * glm::dvec3(-1, 0, 0);
      const Layer layer = drawn(mesh, {turn, {10, 0, 0}}, sun(normal), view_of({9, 9}, 2000));
      sum += layer.color.at<cv::Vec4f>(4, 4)[0] * std::cos(angle) * std::sin(angle) * 2 * M_PI * (M_PI / 2 / kRings);
    }
    // (n + 8) / (8 pi) is short for (n + 2) (n + 4) / (8 pi (n + 2^(-n/2))), which is exact for light from straight
    // above; Fresnel's rise at 30 degrees from the normal is below one percent of the rest.
    const double exact =
        (shininess + 8) * (shininess + std::pow(2, -shininess / 2)) / (shininess + 2) / (shininess + 4);
    CHECK(sum / M_PI == doctest::Approx(0.1 * exact).epsilon(0.02));
    CHECK(sum / M_PI < 0.11);
  }
}

TEST_CASE("glass mirrors the sky at a grazing angle and lets light through squarely") {
  Material glass = paint({0, 0, 0}, 0.35F);
  glass.specular = glm::vec3(0.6F);
  const Light light = sky_and_ground(glm::dvec3(0.5), glm::dvec3(0.125));
  const cv::Vec4f square = middle_of(wall_of(glass), light);
  CHECK(square[3] == doctest::Approx(1 - 0.96 * 0.65).epsilon(1e-5));
  // A level pane above the eye mirrors the ground, one below it the sky.
  for (const double tilt_deg : {75.0, -75.0}) {
    const glm::dquat turn = glm::angleAxis(glm::radians(tilt_deg), glm::dvec3(0, -1, 0));
    const cv::Vec4f color = middle_of(wall_of(glass), light, turn);
    const double mirrored = schlick(0.04, std::cos(glm::radians(75.0)));
    CHECK(color[0] == doctest::Approx(mirrored * (tilt_deg > 0 ? 0.5 : 0.125)).epsilon(1e-4));
    CHECK(color[3] == doctest::Approx(1 - (1 - mirrored) * 0.65).epsilon(1e-4));
  }
}

TEST_CASE("a matt transparent disc, as of a propeller, mirrors nothing") {
  const cv::Vec4f color = middle_of(wall_of(paint({1, 1, 1}, 0.25F)), sky_and_ground(glm::dvec3(1), glm::dvec3(1)),
                                    glm::angleAxis(1.4, glm::dvec3(0, 0, 1)));
  CHECK(color[0] == doctest::Approx(0.25).epsilon(1e-5));
  CHECK(color[3] == doctest::Approx(0.25).epsilon(1e-5));
}

TEST_CASE("a plate before a wall casts its shadow where the sun's rays say, and not elsewhere") {
  // Wall across X; the plate 1 m before it, 1 m x 1 m. The sun is behind the camera, to the right and above: the shadow
  // lies to the left and below.
  Mesh mesh;
  mesh.materials = {kWhite};
  add_quad(mesh, {0, -4, 4}, {0, 8, 0}, {0, 0, -8}, 0);
  add_quad(mesh, {-1, -0.5F, 0.5F}, {0, 1, 0}, {0, 0, -1}, 0);
  mesh = measured(std::move(mesh));
  const glm::dvec3 to_sun = glm::normalize(glm::dvec3(-1, 2, -1.5));
  const Light light = sun(to_sun);
  constexpr int kSide = 401;
  constexpr double kFocal = 5000;
  constexpr double kAway = 100;  // nearly parallel rays
  const Layer layer = drawn(mesh, at({kAway, 0, 0}), light, view_of({kSide, kSide}, kFocal));
  const float lit = static_cast<float>(-to_sun.x);
  int wrong = 0;
  int shaded = 0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const glm::dvec2 at_wall = glm::dvec2(i - kSide / 2, j - kSide / 2) * kAway / kFocal;  // y, z
      const glm::dvec2 at_plate = at_wall * (kAway - 1) / kAway;
      if (std::max(std::abs(at_plate.x), std::abs(at_plate.y)) < 0.52) continue;  // the plate itself is seen here
      if (std::max(std::abs(at_wall.x), std::abs(at_wall.y)) > 3.95) continue;
      // From the wall to the plane of the plate along the sun's ray.
      const glm::dvec2 hit = at_wall + glm::dvec2(to_sun.y, to_sun.z) / -to_sun.x;
      const double beyond = std::max(std::abs(hit.x), std::abs(hit.y)) - 0.5;
      if (std::abs(beyond) < 0.06) continue;  // three pixels: the width of the filter
      shaded += beyond < 0 ? 1 : 0;
      const float expected = beyond < 0 ? 0 : lit;
      wrong += std::abs(layer.color.at<cv::Vec4f>(j, i)[0] - expected) > 1e-5F ? 1 : 0;
    }
  CHECK(shaded > 1500);
  CHECK(wrong == 0);
}

TEST_CASE("a convex body does not shadow its own sunny side, from wherever the sun comes") {
  // Acne would darken samples of faces that look to the sun; a leak would light those that look away.
  const Mesh mesh = box({3, 0.5F, 1}, kWhite);
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 to_sun = towards(15.0 * i + 3, 7.0 * i - 85);
    for (const double turn : {0.4, 1.3, 2.2}) {
      const glm::dquat rotation = glm::angleAxis(turn, glm::normalize(glm::dvec3(1, 2, 3)));
      const Layer layer = drawn(mesh, {rotation, {20, 0, 0}}, sun(to_sun), view_of({121, 121}, 300));
      CHECK(is_valid(layer));
      // All colours there are on a box: those of its lit faces, and black.
      std::vector<double> allowed{0};
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
          glm::dvec3 out(0);
          out[axis] = sign;
          allowed.push_back(std::max(0.0, glm::dot(rotation * out, to_sun)));
        }
      int odd = 0;
      for (int y = 0; y < layer.color.rows; ++y)
        for (int x = 0; x < layer.color.cols; ++x) {
          if (layer.coverage.at<float>(y, x) < 1) continue;
          double nearest = 1;
          for (const double one : allowed)
            nearest = std::min(nearest, std::abs(one - layer.color.at<cv::Vec4f>(y, x)[0]));
          // Pixels on an edge mix two faces.
          bool is_inside = true;
          for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            const cv::Vec4f next = layer.color.at<cv::Vec4f>(std::clamp(y + dy, 0, 120), std::clamp(x + dx, 0, 120));
            is_inside = is_inside && std::abs(next[0] - layer.color.at<cv::Vec4f>(y, x)[0]) < 1e-4F;
          }
          odd += is_inside && nearest > 1e-4 ? 1 : 0;
        }
      CHECK(odd == 0);
    }
  }
}

TEST_CASE("glass casts no shadow, clear texels of a texture neither, opaque ones do") {
  const auto wall_behind = [](const Material& material) {
    Mesh mesh;
    mesh.materials = {kWhite, material};
    add_quad(mesh, {0, -2, 2}, {0, 4, 0}, {0, 0, -4}, 0);
    add_quad(mesh, {-1, 2, 0.5F}, {0, 2, 0}, {0, 0, -1}, 1);  // to the right, out of the eye's way
    return measured(std::move(mesh));
  };
  const glm::dvec3 to_sun(-1, 3, 0);  // through the plate to the wall's middle
  const double lit = 1 / std::sqrt(10.0);
  CHECK(middle_of(wall_behind(paint({1, 1, 1}, 0.5F)), sun(to_sun))[0] == doctest::Approx(lit).epsilon(1e-5));
  CHECK(middle_of(wall_behind(kWhite), sun(to_sun))[0] == 0);
  Material net = kWhite;
  net.texture = cv::Mat(8, 8, CV_8UC4, cv::Scalar(255, 255, 255, 0));
  CHECK(middle_of(wall_behind(net), sun(to_sun))[0] == doctest::Approx(lit).epsilon(1e-5));
  net.texture = cv::Mat(8, 8, CV_8UC4, cv::Scalar(255, 255, 255, 255));
  net.texture.at<cv::Vec4b>(0, 0)[3] = 0;  // a texture that lets light through in one place
  CHECK(middle_of(wall_behind(net), sun(to_sun))[0] == 0);
}

TEST_CASE("the sun behind the body, at the zenith and the nadir, an eye within and odd normals give no NaN") {
  Material odd = paint({1, 1, 1});
  odd.specular = {1, 1, 1};
  odd.shininess = 0;
  for (const float opacity : {1.0F, 0.5F}) {
    odd.opacity = opacity;
    for (const double normal_length : {1.0, 0.0}) {
      Mesh mesh = box({1, 1, 1}, odd);
      for (Vertex& vertex : mesh.vertices) vertex.normal *= static_cast<float>(normal_length);
      for (const glm::dvec3 to_sun : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1),
                                      glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 0), glm::dvec3(1e-300, 1e300, 0)}) {
        Light light = sun(to_sun);
        light.sky_color = {0.3, 0.3, 0.3};
        for (const glm::dvec3 place : {glm::dvec3(10, 0, 0), glm::dvec3(0, 0, 0), glm::dvec3(1, 1, 1),
                                       glm::dvec3(0.9, 0, 0), glm::dvec3(1e7, 0, 0)})
          CHECK(is_valid(drawn(mesh, at(place), light, view_of({33, 33}, place.x > 1e3 ? 1e8 : 40))));
      }
    }
  }
}

TEST_CASE("normals that point inward are lit as those that point outward") {
  Mesh mesh = box({1, 1, 1}, kWhite);
  const Light light = sun({-1, 0.5, -0.5});
  const cv::Vec4f outward = middle_of(mesh, light);
  for (Vertex& vertex : mesh.vertices) vertex.normal = -vertex.normal;
  CHECK(middle_of(mesh, light) == outward);
  CHECK(outward[0] > 0.5F);
}

TEST_CASE("a view and the same view drawn again after another light are the same bytes") {
  const Mesh mesh = box({1, 2, 1}, glossy_black(0.5F, 20));
  const VirtualCamera view = view_of({65, 65}, 200);
  const Light light{
      .color = {1, 0.9, 0.8}, .kind = Light::Kind::sun, .to_sun = {-1, 1, -1}, .sky_color = {0.2, 0.2, 0.3}};
  const Layer before_point = drawn(mesh, at({10, 0, 0}), Light{}, view);
  const Layer first = drawn(mesh, at({10, 0, 0}), light, view);
  const Layer point = drawn(mesh, at({10, 0, 0}), Light{}, view);
  (void)drawn(box({30, 2, 1}, kWhite), at({50, 0, 0}), light, view_of({900, 900}, 900));  // a larger map of shadows
  const Layer again = drawn(mesh, at({10, 0, 0}), light, view);
  CHECK(same_bytes(before_point.color, point.color));
  CHECK(same_bytes(first.color, again.color));
  CHECK_FALSE(same_bytes(first.color, point.color));
}

}  // namespace sigs
