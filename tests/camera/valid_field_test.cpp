// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/pose.h"
#include "camera/camera.h"
#include "camera/example_lenses.h"
#include "camera/lens.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

Lens brown(std::vector<double> coefficients) {
  return lens_of(LensModel::brown_conrady, 1000, 1000, {0, 0}, std::move(coefficients));
}

double valid_radius(const Lens& lens) {
  return std::tan(lens.valid_angle_rad());
}

Camera real_camera(const std::string& name) {
  auto camera = read_calibration(real_data() / "calibrations" / name, cv::Size(640, 480));
  REQUIRE(camera.has_value());
  return *std::move(camera);
}

// Smallest determinant of OpenCV's map along a circle of the plane at distance 1: the area of the image of a small
// square over the square's own; px^2, negative where the orientation is reversed.
double smallest_opencv_determinant(const Lens& lens, double radius) {
  constexpr int kSpokes = 360;
  const double h = 1e-5 * std::max(0.1, radius);
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < kSpokes; ++i) {
    const glm::dvec3 p = radius * direction(std::numbers::pi / 2, 2 * std::numbers::pi * i / kSpokes);
    for (const glm::dvec3& step :
         {glm::dvec3{0, h, 0}, glm::dvec3{0, -h, 0}, glm::dvec3{0, 0, h}, glm::dvec3{0, 0, -h}})
      corners.push_back(glm::dvec3{1, p.y, p.z} + step);
  }
  const std::vector<glm::dvec2> at = opencv_pixels(lens, corners);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < at.size(); i += 4) {
    const glm::dvec2 by_x = (at[i] - at[i + 1]) / (2 * h);
    const glm::dvec2 by_y = (at[i + 2] - at[i + 3]) / (2 * h);
    smallest = std::min(smallest, by_x.x * by_y.y - by_x.y * by_y.x);
  }
  return smallest;
}

}  // namespace

TEST_CASE("the map of OpenCV keeps its orientation in the field and loses it beyond") {
  for (const ExampleLens& example : all_lenses()) {
    const Lens& lens = example.lens;
    if (lens.parameters().model != LensModel::brown_conrady) continue;
    INFO(example.name);
    const double radius = std::min(valid_radius(lens), 20.0);
    for (int i = 1; i < 100; ++i) {
      if (example.name.find("tilt") != std::string::npos && i > 95) break;  // differences fail near the tilt's horizon
      CHECK(smallest_opencv_determinant(lens, radius * 0.01 * i) > 0);
    }
    const bool ends_at_a_fold = valid_radius(lens) < 20 && example.name.find("pole") == std::string::npos &&
                                example.name.find("tilt") == std::string::npos;
    if (ends_at_a_fold) CHECK(smallest_opencv_determinant(lens, radius * 1.001) < 0);
  }
}

TEST_CASE("beyond the field there is no pixel though OpenCV gives one") {
  const Lens lens = brown({-0.3, 0, 0, 0});  // folds where 1 = 0.9 r^2
  const double fold = std::sqrt(1 / 0.9);
  CHECK(valid_radius(lens) == doctest::Approx(fold).epsilon(1e-14));
  CHECK(lens.pixel({1, fold * (1 - 1e-9), 0}).has_value());
  CHECK_FALSE(lens.pixel({1, fold * (1 + 1e-9), 0}).has_value());
  const double widest_px = 1000 * fold * 2 / 3;  // 1 - 0.3 r^2 = 2/3 there
  CHECK(lens.ray({widest_px - 1e-6, 0}).has_value());
  CHECK_FALSE(lens.ray({widest_px + 1e-6, 0}).has_value());
}

TEST_CASE("tangential terms end the field where their closed form folds") {
  // For k = 0 the determinant towards the worst side is (1 - 2 q) (1 - 6 q) with q = |(p1, p2)| r.
  const Lens lens = brown({0, 0, 0.03, -0.04});
  CHECK(valid_radius(lens) == doctest::Approx(1 / (6 * 0.05)).epsilon(1e-9));  // a minimum found by search
}

TEST_CASE("a pole of the denominator ends the field") {
  const Lens lens = brown({0, 0, 0, 0, 0, -1, 0, 0});  // r / (1 - r^2)
  CHECK(lens.valid_angle_rad() < std::numbers::pi / 4);
  CHECK(lens.valid_angle_rad() == doctest::Approx(std::numbers::pi / 4).epsilon(1e-6));  // where it is 1e-6
  CHECK_FALSE(lens.pixel({1, 1.5, 0}).has_value());
  const auto near = lens.pixel({1, 0.9, 0});
  REQUIRE(near.has_value());
  CHECK(near->x == doctest::Approx(1000 * 0.9 / 0.19).epsilon(1e-13));  // rounding
}

TEST_CASE("a tilted sensor ends the field where rays run parallel to it") {
  std::vector<double> tilt(14, 0.0);
  tilt[12] = 0.3;
  const Lens lens = brown(tilt);
  CHECK(lens.valid_angle_rad() == doctest::Approx(std::numbers::pi / 2 - 0.3).epsilon(1e-5));  // 1e-6 of the depth
}

TEST_CASE("a fold as narrow as a millionth is found") {
  // slope 1 + 3 k1 u + 5 k2 u^2 proportional to (u - 1)^2 - 1e-12
  const double scale = 1 / (1 - 1e-12);
  const Lens lens = brown({-2 * scale / 3, scale / 5, 0, 0});
  CHECK(valid_radius(lens) == doctest::Approx(std::sqrt(1 - 1e-6)).epsilon(1e-9));
}

TEST_CASE("a narrow fold that only the tangential terms cause is found") {
  // slope proportional to (u - 1)^2 + 1e-4: monotonic alone, but flat enough for |p| = 1e-4 to fold it near u = 1
  const double scale = 1 / (1 + 1e-4);
  const std::vector<double> radial{-2 * scale / 3, scale / 5, 0, 0};
  CHECK(valid_radius(brown(radial)) > 1e7);
  std::vector<double> tangential = radial;
  tangential[2] = 1e-4;
  const Lens lens = brown(tangential);
  CHECK(valid_radius(lens) < 1);
  CHECK(valid_radius(lens) > 0.95);
  CHECK(smallest_opencv_determinant(lens, valid_radius(lens) * 0.999) > 0);
  CHECK(smallest_opencv_determinant(lens, valid_radius(lens) * 1.001) < 0);
}

TEST_CASE("a fold of a twenty thousandth that only the tangential terms cause is found") {
  // The slope is ((u - 1.7)^2 + d) / (1.7^2 + d) with d = 1e-6. With R = N / D the determinant towards the worst side
  // is R (slope - 6 |p| r) but for |p|^2; p is chosen so that it is negative where (u - 1.7)^2 < 0.01 d = 1e-8.
  constexpr double kMiddle = 1.7;
  constexpr double kDepth = 1e-6;
  constexpr double kScale = 1 / (kMiddle * kMiddle + kDepth);
  const std::vector<double> radial{-2 * kMiddle * kScale / 3, kScale / 5, 0, 0};
  CHECK(valid_radius(brown(radial)) > 1e7);
  std::vector<double> tangential = radial;
  tangential[3] = 1.01 * kDepth * kScale / (6 * std::sqrt(kMiddle));
  CHECK(valid_radius(brown(tangential)) == doctest::Approx(std::sqrt(kMiddle - 1e-4)).epsilon(1e-5));  // |p|^2
}

TEST_CASE("a lens with pincushion distortion has an image of nearly everything before it") {
  const Lens lens = brown({0.3, 0.1, 0, 0});
  CHECK(deg_of_rad(lens.valid_angle_rad()) > 89.99999);
  CHECK(lens.pixel({1e-3, 1e3, 0}).has_value());
}

TEST_CASE("a fisheye has an image up to its fold or all around") {
  const auto fisheye = [](std::vector<double> k) {
    return lens_of(LensModel::kannala_brandt, 300, 300, {0, 0}, std::move(k)).valid_angle_rad();
  };
  CHECK(fisheye({0, 0, 0, 0}) == std::numbers::pi);
  CHECK(fisheye({0.1, 0, 0, 0}) == std::numbers::pi);
  CHECK(fisheye({-0.1, 0, 0, 0}) == doctest::Approx(std::sqrt(1 / 0.3)).epsilon(1e-14));  // 1 = 3 * 0.1 theta^2
  const double narrow = 1 / (4 - 1e-12);  // slope proportional to (theta^2 - 2)^2 - 1e-12
  CHECK(fisheye({-4 * narrow / 3, narrow / 5, 0, 0}) == doctest::Approx(std::sqrt(2 - 1e-6)).epsilon(1e-9));
}

TEST_CASE("models that look at a sphere have an image within the cone that shows it one to one") {
  const auto valid_rad = [](LensModel model, std::vector<double> coefficients) {
    return lens_of(model, 300, 300, {0, 0}, std::move(coefficients)).valid_angle_rad();
  };
  // Seen from xi behind the middle: the pole of the projection at cos = -xi or, from outside, the rim at cos = -1 / xi.
  for (const double xi : {0.0, 0.5, 0.954, 1.0})
    CHECK(valid_rad(LensModel::omnidirectional, {xi}) == doctest::Approx(std::acos(-xi)).epsilon(1e-14));
  for (const double xi : {1.25, 2.0, 1e3})
    CHECK(valid_rad(LensModel::omnidirectional, {xi}) == doctest::Approx(std::acos(-1 / xi)).epsilon(1e-7));  // a fold
  // Where alpha is below a half the denominator has a zero: alpha d = -(1 - alpha) z; above it the distance has a peak.
  CHECK(valid_rad(LensModel::extended_unified, {0.2, 1}) == doctest::Approx(std::acos(-0.25)).epsilon(1e-14));
  CHECK(valid_rad(LensModel::extended_unified, {0.8, 1}) == doctest::Approx(std::acos(-0.25)).epsilon(1e-7));
  CHECK(valid_rad(LensModel::extended_unified, {0.5, 3}) == doctest::Approx(std::numbers::pi).epsilon(1e-7));
  CHECK(valid_rad(LensModel::extended_unified, {0, 2}) == doctest::Approx(std::numbers::pi / 2).epsilon(1e-14));
  CHECK(valid_rad(LensModel::double_sphere, {0, 0.2}) == doctest::Approx(std::acos(-0.25)).epsilon(1e-14));
  CHECK(valid_rad(LensModel::double_sphere, {0, 0}) == doctest::Approx(std::numbers::pi / 2).epsilon(1e-14));
  const Lens far = lens_of(LensModel::omnidirectional, 300, 300, {0, 0}, {0.5});
  CHECK(far.pixel({-0.499, std::sqrt(1 - 0.499 * 0.499), 0}).has_value());
  CHECK_FALSE(far.pixel({-0.501, std::sqrt(1 - 0.501 * 0.501), 0}).has_value());
  CHECK_FALSE(far.pixel({-1, 0, 0}).has_value());
  CHECK_FALSE(far.pixel({0, 0, 0}).has_value());
}

TEST_CASE("models that look at a sphere agree where they are the same") {
  constexpr double kXi = 0.7;
  constexpr double kAlpha = kXi / (1 + kXi);  // with beta = 1: the sphere seen from xi, 1 + xi times as large
  const Lens omni =
      lens_of(LensModel::omnidirectional, 300 * (1 + kXi), 320 * (1 + kXi), {310, 250}, {kXi, 0, 0, 0, 0});
  const Lens unified = lens_of(LensModel::extended_unified, 300, 320, {310, 250}, {kAlpha, 1});
  const Lens sphere = lens_of(LensModel::double_sphere, 300, 320, {310, 250}, {0, kAlpha});
  const Lens pinhole = lens_of(LensModel::brown_conrady, 300, 320, {310, 250}, {});
  const Lens as_flat = lens_of(LensModel::omnidirectional, 300, 320, {310, 250}, {0});
  for (const glm::dvec3& at : directions_over(omni, 20, 12, 0.99)) {
    const glm::dvec2 expected = omni.pixel(at).value();
    const double rounding_px = 1e-12 * (1 + glm::length(expected));  // grows with 1 / depth
    CHECK(glm::distance(unified.pixel(at).value(), expected) < 10 * rounding_px);
    CHECK(glm::distance(sphere.pixel(at).value(), expected) < 10 * rounding_px);
  }
  for (const glm::dvec3& at : directions_over(pinhole, 10, 12, 0.9))
    CHECK(glm::distance(as_flat.pixel(at).value(), pinhole.pixel(at).value()) < 1e-9);
  for (const Lens* lens : {&omni, &unified, &sphere, &as_flat}) {
    const LensParameters& middle = lens->pinhole().parameters();
    CHECK(middle.fx == doctest::Approx(300).epsilon(1e-14));
    CHECK(middle.fy == doctest::Approx(320).epsilon(1e-14));
    CHECK(lens->pixels_per_radian({1, 0, 0}) == doctest::Approx(320).epsilon(1e-14));
  }
}

TEST_CASE("the wide camera of a real UAV folds at 57.3 degrees") {
  if (!has_real_data()) return;
  const Camera camera = real_camera("uav_skyeye_out_camera_data.xml");
  CHECK(deg_of_rad(camera.lens.valid_angle_rad()) == doctest::Approx(57.3).epsilon(0.001));  // stated to 0.05 degrees
  CHECK_FALSE(camera.lens.ray({0, 0}).has_value());
  CHECK_FALSE(camera.lens.ray({639, 479}).has_value());
  CHECK_FALSE(camera.lens.ray({320, 0}).has_value());  // no more than 225 px from the middle
  CHECK(camera.lens.ray({320, 16}).has_value());
}

TEST_CASE("the corners of the stereo calibration in OpenCV's samples are unreachable") {
  if (!has_real_data()) return;
  const Camera camera = real_camera("opencv_doc_stereo_intrinsics_M1D1.yml");
  CHECK(valid_radius(camera.lens) == doctest::Approx(0.73).epsilon(0.005));  // stated to two digits
  CHECK_FALSE(camera.lens.ray({0, 0}).has_value());
  CHECK(camera.lens.ray({200, 200}).has_value());
}

TEST_CASE("a real lens that folds just outside the image's corner still has a ray for the corner") {
  if (!has_real_data()) return;
  const Camera camera = real_camera("ntu_mecatron_out_camera_data.xml");
  for (const glm::dvec2& corner : {glm::dvec2{0, 0}, glm::dvec2{639, 0}, glm::dvec2{0, 479}, glm::dvec2{639, 479}}) {
    const auto ray = camera.lens.ray(corner);
    REQUIRE(ray.has_value());
    const double share = std::hypot(ray->y, ray->z) / ray->x / valid_radius(camera.lens);
    CHECK(share > 0.7);
    CHECK(share < 1);
  }
}

}  // namespace sigs::test
