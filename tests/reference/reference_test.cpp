// SPDX-License-Identifier: MIT
#include "reference/reference.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "reference/synthetic_bodies.h"

namespace sigs::truth {
namespace {

const cv::Size kSize(320, 240);
constexpr double kFocal_px = 300;

cv::Vec4d color_at(const ReferenceImage& truth, int x, int y) {
  return truth.color.at<cv::Vec4d>(y - truth.rect.y, x - truth.rect.x);
}

// Of the blurred opacity along x: mean and variance.
glm::dvec2 moments(const ReferenceImage& truth) {
  double sum = 0;
  double first = 0;
  double second = 0;
  for (int y = 0; y < truth.rect.height; ++y)
    for (int x = 0; x < truth.rect.width; ++x) {
      const double a = truth.color.at<cv::Vec4d>(y, x)[3];
      sum += a, first += a * x, second += a * x * x;
    }
  return {truth.rect.x + first / sum, second / sum - (first / sum) * (first / sum)};
}

}  // namespace

TEST_CASE("a square has the area, the place and the box that a pinhole gives it") {
  const Mesh mesh = square(painted({1, 1, 1}), 2);
  for (const glm::dvec2 place : {glm::dvec2{0, 0}, glm::dvec2{3.37, -1.91}}) {
    const ReferenceImage truth = reference_image(setup_for(mesh, {40, place.x, place.y}, kFocal_px, kSize));
    const double side_px = kFocal_px * 2 / 40;
    CHECK(truth.area_px == doctest::Approx(side_px * side_px).epsilon(1e-3));
    CHECK(cv::sum(truth.coverage)[0] == doctest::Approx(truth.area_px).epsilon(1e-12));
    const glm::dvec2 middle_px = glm::dvec2(159.5, 119.5) + place * kFocal_px / 40.0;
    CHECK(glm::distance(truth.centroid_px, middle_px) < 1e-3);
    // A ray's square is 1 / 256 of the side or less.
    CHECK(std::abs(truth.silhouette.x - (middle_px.x - side_px / 2)) < side_px / 256);
    CHECK(std::abs(truth.silhouette.width - side_px) < 2 * side_px / 256);
  }
}

TEST_CASE("a sphere off the axis is the ellipse that cuts its cone") {
  constexpr double kRadius_m = 3;
  const Mesh mesh = sphere(kRadius_m);
  const glm::dvec3 p(20, 6, 4);
  const ReferenceImage truth = reference_image(setup_for(mesh, p, kFocal_px, kSize));
  const double sine_squared = kRadius_m * kRadius_m / glm::dot(p, p);  // of the cone's half angle
  const double cosine_squared = p.x * p.x / glm::dot(p, p);            // of its axis' angle from the camera's
  const double below = cosine_squared - sine_squared;
  const double long_axis = std::sqrt(sine_squared * (1 - sine_squared)) / below;
  const double short_axis = std::sqrt(sine_squared / below);
  CHECK(truth.area_px ==
        doctest::Approx(std::numbers::pi * long_axis * short_axis * kFocal_px * kFocal_px).epsilon(1e-3));
  const double from_axis = std::sqrt(cosine_squared * (1 - cosine_squared)) / below;
  const glm::dvec2 away = glm::normalize(glm::dvec2(p.y, p.z));
  CHECK(glm::distance(truth.centroid_px, glm::dvec2(159.5, 119.5) + away * from_axis * kFocal_px) < 1e-2);
}

TEST_CASE("a band around a fisheye is the ring between its two angles, beyond 90 degrees too") {
  const Mesh mesh = band(5, 5 / std::tan(1.3), 5 / std::tan(1.8));
  Setup setup = setup_for(mesh, {0, 0, 0}, 50, {320, 320});
  setup.lens.model = LensModel::kannala_brandt;
  setup.lens.coefficients = {0.02, -0.01, 0.003, -0.0004};
  const ReferenceImage truth = reference_image(setup, {.samples_per_side = 4});
  const auto radius_px = [](double theta) {
    const double t = theta * theta;
    return 50 * theta * (1 + t * (0.02 + t * (-0.01 + t * (0.003 - t * 0.0004))));
  };
  const double ring_px = std::numbers::pi * (std::pow(radius_px(1.8), 2) - std::pow(radius_px(1.3), 2));
  CHECK(truth.area_px == doctest::Approx(ring_px).epsilon(1e-3));
  CHECK(glm::distance(truth.centroid_px, glm::dvec2(159.5)) < 1e-2);
}

TEST_CASE("a square that faces the light has the model's colour") {
  Material paint = painted({0.5F, 0.8F, 0.2F});
  paint.specular = {0.4F, 0.2F, 0};
  paint.shininess = 1;
  const Mesh mesh = square(paint, 2);
  Setup setup = setup_for(mesh, {40, 0, 0}, kFocal_px, kSize);
  setup.light_color = {0.5, 1, 2};
  setup.ambient = 0.3;
  const ReferenceImage truth = reference_image(setup);
  const cv::Vec4d color = color_at(truth, 160, 120);
  // Along the axis n, light and eye agree up to a third of a degree, so all cosines are 1 within 1e-5.
  const double light[3] = {0.21404114, 0.60382734, 0.03310477};  // of 0.5, 0.8, 0.2: sRGB's tables
  const double specular[3] = {0.4, 0.2, 0};
  for (int c = 0; c < 3; ++c)
    CHECK(color[c] == doctest::Approx(setup.light_color[c] * (light[c] + 0.25 * 0.7 * specular[c])).epsilon(2e-5));
  CHECK(color[3] == doctest::Approx(1).epsilon(1e-12));
  setup.light_in_camera = {1e9, 0, 0};  // behind it: the rest is ambient
  CHECK(color_at(reference_image(setup), 160, 120)[0] == doctest::Approx(0.5 * 0.3 * light[0]).epsilon(1e-6));
}

TEST_CASE("light that falls at 60 degrees gives half of the direct light") {
  const Mesh mesh = square(painted({1, 1, 1}), 2);
  Setup setup = setup_for(mesh, {40, 0, 0}, kFocal_px, kSize);
  setup.ambient = 0.2;
  setup.light_in_camera = 1e9 * glm::dvec3(-0.5, std::sqrt(0.75), 0);
  CHECK(color_at(reference_image(setup), 160, 120)[1] == doctest::Approx(0.2 + 0.8 * 0.5).epsilon(1e-6));
}

TEST_CASE("a face in the sun has the light of sun, sky and ground, each by its cosine") {
  const Mesh mesh = square(painted({1, 1, 1}), 2);
  Setup setup = setup_for(mesh, {40, 0, 0}, kFocal_px, kSize);
  setup.in_sun = true;
  setup.light_color = {1, 0.5, 0.25};
  setup.exposure = 0.5;
  setup.to_sun_in_camera = {-0.5, std::sqrt(0.75), 0};
  setup.sky_color = {0.4, 0, 0.2};
  setup.ground_color = {0.1, 0.1, 0};
  const cv::Vec4d upright = color_at(reference_image(setup), 160, 120);
  // Upright it sees sky and ground alike.
  CHECK(upright[0] == doctest::Approx(0.5 * (0.5 + 0.25)).epsilon(1e-6));
  CHECK(upright[1] == doctest::Approx(0.5 * (0.25 + 0.05)).epsilon(1e-6));
  CHECK(upright[2] == doctest::Approx(0.5 * (0.125 + 0.1)).epsilon(1e-6));
  setup.to_sun_in_camera = {1, 0.1, 0};  // behind it
  setup.up_in_camera = {-1, 0, 0};       // the camera looks down
  CHECK(color_at(reference_image(setup), 160, 120)[0] == doctest::Approx(0.5 * 0.4).epsilon(1e-6));
}

TEST_CASE("a square before a wall shades the part of it that the sun's rays through the square meet") {
  Mesh mesh;
  add_square(mesh, painted({1, 1, 1}), 0, {0, 0}, 8);
  add_square(mesh, painted({1, 1, 1}), -1, {-2, 0}, 1);  // 1 m before the wall, to the left
  Setup setup = setup_for(mesh, {40, 0, 0}, kFocal_px, kSize);
  setup.in_sun = true;
  setup.to_sun_in_camera = {-1, -2, 0};  // on the way from the wall to the plate's plane it goes 2 m to the left
  const ReferenceImage truth = reference_image(setup);
  // The shadow is the square -0.5 .. 0.5 of the wall, 3.75 pixels either way; black, as there is no sky.
  const double lit = 1 / std::sqrt(5.0);
  CHECK(color_at(truth, 160, 120)[0] == 0);
  CHECK(color_at(truth, 162, 122)[0] == 0);
  for (const int x : {154, 166}) CHECK(color_at(truth, x, 120)[0] == doctest::Approx(lit).epsilon(1e-6));
  for (const int y : {114, 126}) CHECK(color_at(truth, 160, y)[0] == doctest::Approx(lit).epsilon(1e-6));
  // Its area, by the light that is missing.
  double missing = 0;
  for (int y = 112; y <= 128; ++y)
    for (int x = 152; x <= 168; ++x) missing += lit - color_at(truth, x, y)[0];
  CHECK(missing / lit == doctest::Approx(7.5 * 7.5).epsilon(0.01));
}

TEST_CASE("a pane mirrors more the flatter it is looked at, as Fresnel's equations say") {
  Material glass = painted({0, 0, 0}, 0.2F);
  glass.specular = {0.5F, 0.5F, 0.5F};
  const Mesh mesh = square(glass, 2);
  Setup setup = setup_for(mesh, {40, 0, 0}, kFocal_px, kSize);
  setup.in_sun = true;
  setup.light_color = {0, 0, 0};
  setup.sky_color = setup.ground_color = {1, 1, 1};
  double last = 0;
  for (const double angle_deg : {0.0, 40.0, 60.0, 75.0}) {
    const double angle = angle_deg * std::numbers::pi / 180;
    setup.camera_from_body.rotation = glm::angleAxis(angle, glm::dvec3(0, 0, 1));
    const double mirrored = color_at(reference_image(setup), 160, 120)[0];
    // Fresnel's equations for unpolarised light and n = 1.5; Schlick's approximation is within 0.03 of them.
    const double inner = std::sqrt(1 - std::pow(std::sin(angle) / 1.5, 2));
    const double s = (std::cos(angle) - 1.5 * inner) / (std::cos(angle) + 1.5 * inner);
    const double p = (1.5 * std::cos(angle) - inner) / (1.5 * std::cos(angle) + inner);
    CHECK(std::abs(mirrored - (s * s + p * p) / 2) < 0.03);
    CHECK(mirrored > last);
    last = mirrored;
  }
}

TEST_CASE("blur adds its variance and keeps the energy") {
  const Mesh mesh = square(painted({1, 1, 1}), 2);
  Setup setup = setup_for(mesh, {40, 0.13, 0}, kFocal_px, kSize);
  const ReferenceImage sharp = reference_image(setup);
  for (const double sigma_px : {1.0, 2.0, 2.0001, 5.0, 17.0}) {  // at once up to 2, by nodes above
    CAPTURE(sigma_px);
    setup.sigma_px = sigma_px;
    const ReferenceImage soft = reference_image(setup);
    for (int c = 0; c < 4; ++c) CHECK(cv::sum(soft.color)[c] == doctest::Approx(cv::sum(sharp.color)[c]).epsilon(1e-6));
    // Pixels are boxes whatever the blur, so their 1 / 12 is in both. The part beyond six sigmas is 1e-7 of sigma^2.
    CHECK(moments(soft).x == doctest::Approx(moments(sharp).x).epsilon(1e-5));
    CHECK(moments(soft).y - 15 * 15 / 12.0 - 1 / 12.0 == doctest::Approx(sigma_px * sigma_px).epsilon(2e-3));
    CHECK(soft.area_px == sharp.area_px);
  }
}

TEST_CASE("blur brings in light from outside the image") {
  const Mesh mesh = square(painted({1, 1, 1}), 2);
  Setup setup = setup_for(mesh, {40, -22.5, 0}, kFocal_px, kSize);  // its right edge at x = -1.75
  CHECK(reference_image(setup).rect.empty());
  setup.sigma_px = 3;
  const ReferenceImage truth = reference_image(setup);
  CHECK(truth.area_px == 0);
  CHECK(truth.rect.x == 0);
  const double share = 0.5 * std::erfc((0.5 + 1.25) / 3 / std::numbers::sqrt2);  // of an edge, in the mean of a pixel
  CHECK(color_at(truth, 0, 119)[3] == doctest::Approx(share).epsilon(0.05));
  CHECK(color_at(truth, 0, 119)[3] > color_at(truth, 3, 119)[3]);
}

TEST_CASE("glass over white transmits by its opacity, in the order of the ray") {
  Mesh mesh;
  add_square(mesh, painted({1, 1, 1}), 1, {0, 0}, 2);
  add_square(mesh, painted({1, 0, 0}, 0.5F), 0, {0, 0}, 2);
  add_square(mesh, painted({0, 1, 0}, 0.25F), -1, {0, 0}, 2);
  Setup setup = setup_for(mesh, {40, 0, 0}, kFocal_px, kSize);
  setup.ambient = 1;
  const cv::Vec4d color = color_at(reference_image(setup), 160, 120);
  CHECK(color[0] == doctest::Approx(0.75 * (0.5 + 0.5)).epsilon(1e-12));
  CHECK(color[1] == doctest::Approx(0.25 + 0.75 * 0.5).epsilon(1e-12));
  CHECK(color[2] == doctest::Approx(0.75 * 0.5).epsilon(1e-12));
  CHECK(color[3] == doctest::Approx(1).epsilon(1e-12));
  const Mesh pane = square(painted({1, 1, 1}, 0.5F), 2);
  setup.mesh = &pane;
  const ReferenceImage truth = reference_image(setup);
  CHECK(color_at(truth, 160, 120)[3] == doctest::Approx(0.5).epsilon(1e-12));
  CHECK(truth.coverage.at<double>(120 - truth.rect.y, 160 - truth.rect.x) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a texture on a surface is oriented as in OBJ, premultiplied and in linear light") {
  Material paint = painted({1, 1, 1});
  paint.texture = cv::Mat(2, 2, CV_8UC4, cv::Scalar(255, 255, 255, 255));
  paint.texture.at<cv::Vec4b>(0, 0) = {255, 0, 0, 255};
  paint.texture.at<cv::Vec4b>(1, 1) = {0, 0, 255, 128};
  const Mesh mesh = square(paint, 2);
  Setup setup = setup_for(mesh, {4, 0, 0}, 180, kSize);  // 90 px; texels of 45 px around 137 and 182
  setup.ambient = 1;
  const ReferenceImage truth = reference_image(setup);
  CHECK(cv::norm(color_at(truth, 137, 97) - cv::Vec4d(1, 0, 0, 1)) < 0.03);  // a pixel is a 45th of a texel
  CHECK(cv::norm(color_at(truth, 182, 142) - cv::Vec4d(0, 0, 0.502, 0.502)) < 0.03);
  // Half way between red and white texels, in light.
  CHECK(cv::norm(color_at(truth, 159, 97) - cv::Vec4d(1, 0.489, 0.489, 1)) < 0.02);
}

TEST_CASE("a target of a hundredth of a pixel covers its true area") {
  const Mesh mesh = square(painted({1, 1, 1}), 2);
  for (const double distance_m : {6e4, 1e7}) {
    const ReferenceImage truth = reference_image(setup_for(mesh, {distance_m, 0.1 * distance_m, 0}, kFocal_px, kSize));
    const double side_px = kFocal_px * 2 / distance_m;
    CHECK(truth.area_px == doctest::Approx(side_px * side_px).epsilon(0.01));
    CHECK(cv::sum(truth.color)[3] == doctest::Approx(side_px * side_px).epsilon(0.01));
  }
}

TEST_CASE("there is no jitter at 1e7 m") {
  const Mesh mesh = sphere(5);
  const ReferenceImage truth = reference_image(setup_for(mesh, {1e7, 3e6, -2e6}, 3e7, {30000000, 30000000}));
  const glm::dvec3 p(1e7, 3e6, -2e6);
  const double area_px =
      std::numbers::pi * 25 / glm::dot(p, p) * 9e14 * std::pow(glm::length(p) / p.x, 3);  // a small cone's section
  CHECK(truth.area_px == doctest::Approx(area_px).epsilon(1e-3));
}

TEST_CASE("behind the camera there is nothing, around it there is only the body") {
  const Mesh ball = sphere(5);
  CHECK(reference_image(setup_for(ball, {-20, 0, 0}, kFocal_px, kSize)).rect.empty());
  const ReferenceImage inside = reference_image(setup_for(ball, {0, 0, 0}, 20, {32, 24}));
  CHECK(inside.area_px == doctest::Approx(32 * 24).epsilon(1e-12));
}

TEST_CASE("the own body removes the coverage it occludes, and the silhouette stays") {
  const Mesh mesh = square(painted({1, 1, 1}), 2);
  Setup setup = setup_for(mesh, {40, 0, 0}, kFocal_px, kSize);
  const ReferenceImage whole = reference_image(setup);
  setup.own_body = cv::Mat(kSize, CV_32FC1, cv::Scalar(0.25));
  const ReferenceImage part = reference_image(setup);
  CHECK(cv::norm(part.color, 0.75 * whole.color, cv::NORM_INF) < 1e-12);
  CHECK(part.area_px == whole.area_px);
}

TEST_CASE("zero coverage leaves a background's code value, and half of white is mixed in linear light") {
  ReferenceImage truth{.rect = {2, 1, 3, 1}, .color = cv::Mat::zeros(1, 3, CV_64FC4)};
  truth.color.at<cv::Vec4d>(0, 1) = {1, 1, 1, 1};
  truth.color.at<cv::Vec4d>(0, 2) = {0.5, 0.5, 0.5, 0.5};
  cv::Mat background(4, 8, CV_8UC3, cv::Scalar(10, 100, 0));
  const cv::Mat codes = over_background(truth, background);
  CHECK(cv::norm(codes.at<cv::Vec3d>(0, 0) - cv::Vec3d(10, 100, 0)) < 1e-9);
  CHECK(cv::norm(codes.at<cv::Vec3d>(0, 1) - cv::Vec3d(255, 255, 255)) < 1e-9);
  CHECK(codes.at<cv::Vec3d>(0, 2)[2] == doctest::Approx(187.516).epsilon(1e-5));  // sRGB of half the light
}

TEST_CASE("the same setup gives the same bytes") {
  const Mesh mesh = sphere(3);
  Setup setup = setup_for(mesh, {20, 6, 4}, 60, kSize);
  setup.sigma_px = 3;
  const ReferenceImage once = reference_image(setup);
  const ReferenceImage twice = reference_image(setup);
  REQUIRE(once.rect == twice.rect);
  CHECK(std::memcmp(once.color.data, twice.color.data, once.color.total() * once.color.elemSize()) == 0);
}

}  // namespace sigs::truth
