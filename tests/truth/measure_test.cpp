// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "base/pose.h"
#include "compositor/synthetic_layers.h"
#include "truth/measure.h"

namespace sigs::test {
namespace {

using CameraFromBody = Pose<frame::Camera, frame::Body>;

constexpr double kFx = 800;
constexpr double kFy = 900;
constexpr double kCx = 320.25;
constexpr double kCy = 200.5;

Lens pinhole() {
  return *Lens::make({.fx = kFx, .fy = kFy, .cx = kCx, .cy = kCy});
}

std::vector<glm::vec3> cuboid(const glm::vec3& half_m) {
  std::vector<glm::vec3> corners;
  for (const float x : {-1.F, 1.F})
    for (const float y : {-1.F, 1.F})
      for (const float z : {-1.F, 1.F}) corners.emplace_back(half_m * glm::vec3(x, y, z));
  return corners;
}

void check_edges(const Box& box, const cv::Point2d& low, const cv::Point2d& high, double tolerance_px) {
  CHECK(std::abs(box.x - low.x) < tolerance_px);
  CHECK(std::abs(box.y - low.y) < tolerance_px);
  CHECK(std::abs(box.x + box.width - high.x) < tolerance_px);
  CHECK(std::abs(box.y + box.height - high.y) < tolerance_px);
}

constexpr float kLeast = 0.05F;

cv::Mat some_coverage(int width, int height, unsigned seed, double share) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  cv::Mat coverage = cv::Mat::zeros(height, width, CV_32FC1);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      if (uniform(random) < share) coverage.at<float>(j, i) = uniform(random) * 4 * kLeast;
  return coverage;
}

}  // namespace

TEST_CASE("the silhouette of a cuboid before a pinhole is that of its nearest and farthest corners") {
  const CameraFromBody pose{{1, 0, 0, 0}, {100, 10, -5}};
  const auto silhouette = silhouette_of(cuboid({4, 3, 2}), pose, pinhole());
  REQUIRE(silhouette.has_value());
  CHECK(silhouette->all_have_image);
  // x = fx Y / X + cx with Y in 7..13, y = fy Z / X + cy with Z in -7..-3, X in 96..104; the rest is rounding.
  check_edges(silhouette->box, {kFx * 7 / 104 + kCx, kFy * -7 / 96 + kCy}, {kFx * 13 / 96 + kCx, kFy * -3 / 104 + kCy},
              1e-9);
}

TEST_CASE("what passes beside a pinhole ends the silhouette where its pixels tell nothing any more") {
  const std::vector<glm::vec3> wing{{1, 5, 0}, {1e-3F, 5, 0}, {1e-9F, 5, 0}};  // up to 90 degrees from the axis
  const auto silhouette = silhouette_of(wing, {{1, 0, 0, 0}, {0, 0, 0}}, pinhole());
  REQUIRE(silhouette.has_value());
  CHECK(silhouette->all_have_image);
  CHECK(silhouette->is_cut);
  CHECK(silhouette->box.width > 1e11);
  REQUIRE(silhouette->near_box);
  CHECK(silhouette->near_box->x == doctest::Approx(kFx * 5 + kCx).epsilon(1e-6));
  CHECK(silhouette->near_box->width == 0);
}

TEST_CASE("turning the body by a right angle swaps its length and its span") {
  const CameraFromBody pose{rotation_of({.yaw_rad = std::numbers::pi / 2}), {100, 0, 0}};
  const auto silhouette = silhouette_of(cuboid({4, 3, 2}), pose, pinhole());
  REQUIRE(silhouette.has_value());
  check_edges(silhouette->box, {kFx * -4 / 97 + kCx, kFy * -2 / 97 + kCy}, {kFx * 4 / 97 + kCx, kFy * 2 / 97 + kCy},
              1e-9);  // rounding
}

TEST_CASE("a rolled body keeps the right wing down") {
  const CameraFromBody pose{rotation_of({.roll_rad = rad_of_deg(30)}), {100, 0, 0}};
  const std::vector<glm::vec3> right_wing_tip{{0, 10, 0}};
  const auto silhouette = silhouette_of(right_wing_tip, pose, pinhole());
  REQUIRE(silhouette.has_value());
  const cv::Point2d tip(kFx * 10 * std::cos(rad_of_deg(30)) / 100 + kCx,
                        kFy * 10 * std::sin(rad_of_deg(30)) / 100 + kCy);
  check_edges(silhouette->box, tip, tip, 1e-9);  // rounding
  CHECK(silhouette->box.width == 0);
}

TEST_CASE("the silhouette of a sphere is its tangent cone") {
  constexpr double kRadius_m = 10;
  constexpr double kDistance_m = 60;
  std::vector<glm::vec3> points;
  for (int i = 0; i <= 360; ++i)
    for (int j = 0; j < 360; j += 5) {
      const double from_nose = rad_of_deg(i / 2.0);
      const double around = rad_of_deg(j);
      points.emplace_back(kRadius_m * std::cos(from_nose), kRadius_m * std::sin(from_nose) * std::cos(around),
                          kRadius_m * std::sin(from_nose) * std::sin(around));
    }
  const auto silhouette = silhouette_of(points, {{1, 0, 0, 0}, {kDistance_m, 0, 0}}, pinhole());
  REQUIRE(silhouette.has_value());
  const double tangent = kRadius_m / std::sqrt(kDistance_m * kDistance_m - kRadius_m * kRadius_m);
  // The rings are half a degree apart: the nearest to the tangent circle misses it by up to a quarter, and the tangent
  // falls off with the square of that, (0.25 degrees)^2 / 2 = 1e-5 of 137 px.
  check_edges(silhouette->box, {kCx - kFx * tangent, kCy - kFy * tangent}, {kCx + kFx * tangent, kCy + kFy * tangent},
              2e-3);
}

TEST_CASE("through a distorted lens the silhouette is what OpenCV projects") {
  const std::vector<double> coefficients{-0.28, 0.07, 0.001, -0.0007, 0.01};
  const Lens lens = *Lens::make({.fx = kFx, .fy = kFy, .cx = kCx, .cy = kCy, .coefficients = coefficients});
  const CameraFromBody pose{rotation_of({.roll_rad = 0.3, .pitch_rad = -0.2, .yaw_rad = 2.1}), {50, -12, 7}};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-8, 8);
  std::vector<glm::vec3> points;
  std::vector<cv::Point3d> optical;
  for (int i = 0; i < 300; ++i) {
    points.emplace_back(uniform(random), uniform(random), uniform(random));
    const glm::dvec3 p = optical_of(pose * glm::dvec3(points.back()));
    optical.emplace_back(p.x, p.y, p.z);
  }
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(optical, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), cv::Matx33d(kFx, 0, kCx, 0, kFy, kCy, 0, 0, 1),
                    coefficients, pixels);
  cv::Point2d low = pixels.front();
  cv::Point2d high = pixels.front();
  for (const cv::Point2d& pixel : pixels) {
    low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
    high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
  }
  const auto silhouette = silhouette_of(points, pose, lens);
  REQUIRE(silhouette.has_value());
  check_edges(silhouette->box, low, high, 1e-8);  // both are doubles; some 1e-13 of 1e3 px, with a margin
}

TEST_CASE("the silhouette extends beyond the edges of any image") {
  const auto silhouette = silhouette_of(cuboid({4, 3, 2}), {{1, 0, 0, 0}, {10, -200, 0}}, pinhole());
  REQUIRE(silhouette.has_value());
  CHECK(silhouette->all_have_image);
  CHECK(std::abs(silhouette->box.x - (kFx * -203 / 6 + kCx)) < 1e-9);  // rounding
}

TEST_CASE("points behind the camera have no silhouette") {
  CHECK_FALSE(silhouette_of(cuboid({4, 3, 2}), {{1, 0, 0, 0}, {-100, 0, 0}}, pinhole()).has_value());
  CHECK_FALSE(silhouette_of({}, {{1, 0, 0, 0}, {100, 0, 0}}, pinhole()).has_value());
}

TEST_CASE("a body partly behind the camera is measured by the points before it and says so") {
  const auto silhouette = silhouette_of(cuboid({20, 3, 2}), {{1, 0, 0, 0}, {10, 0, 0}}, pinhole());
  REQUIRE(silhouette.has_value());
  CHECK_FALSE(silhouette->all_have_image);
  check_edges(silhouette->box, {kFx * -3 / 30 + kCx, kFy * -2 / 30 + kCy}, {kFx * 3 / 30 + kCx, kFy * 2 / 30 + kCy},
              1e-9);  // rounding
}

TEST_CASE("points beyond the field of the lens are left out of the silhouette") {
  // r (1 - 0.3 r^2) grows up to r = 1 / sqrt(0.9), 46.5 degrees.
  const Lens lens = *Lens::make({.fx = kFx, .fy = kFx, .cx = kCx, .cy = kCy, .coefficients = {-0.3, 0, 0, 0}});
  const std::vector<glm::vec3> points{{0, 0, 0}, {0, 50, 0}, {0, 120, 0}};
  const auto silhouette = silhouette_of(points, {{1, 0, 0, 0}, {100, 0, 0}}, lens);
  REQUIRE(silhouette.has_value());
  CHECK_FALSE(silhouette->all_have_image);
  CHECK(silhouette->box.width == doctest::Approx(kFx * 0.5 * (1 - 0.3 * 0.25)).epsilon(1e-12));  // rounding
}

TEST_CASE("without coverage there is no box") {
  CHECK_FALSE(covered_box(cv::Mat(), cv::Rect(), kLeast).has_value());
  CHECK_FALSE(covered_box(cv::Mat::zeros(4, 6, CV_32FC1), {10, 20, 6, 4}, kLeast).has_value());
}

TEST_CASE("the box of one covered pixel is that pixel of the image") {
  cv::Mat coverage = cv::Mat::zeros(4, 6, CV_32FC1);
  coverage.at<float>(2, 5) = 1;
  CHECK(covered_box(coverage, {10, 20, 6, 4}, kLeast) == cv::Rect(15, 22, 1, 1));
}

TEST_CASE("a pixel counts from the minimum coverage on and never without coverage") {
  cv::Mat coverage = cv::Mat::zeros(1, 3, CV_32FC1);
  coverage.at<float>(0, 0) = std::nextafter(kLeast, 0.0F);
  coverage.at<float>(0, 1) = kLeast;
  CHECK(covered_box(coverage, {0, 0, 3, 1}, kLeast) == cv::Rect(1, 0, 1, 1));
  CHECK(covered_box(coverage, {0, 0, 3, 1}, 0) == cv::Rect(0, 0, 2, 1));
  CHECK_FALSE(covered_box(cv::Mat::zeros(2, 3, CV_32FC1), {0, 0, 3, 2}, 0).has_value());
}

TEST_CASE("the maximum coverage is that of the largest pixel, and none without pixels") {
  CHECK(max_coverage(cv::Mat()) == 0);
  CHECK(max_coverage(cv::Mat::zeros(2, 3, CV_32FC1)) == 0);
  cv::Mat coverage = cv::Mat::zeros(2, 3, CV_32FC1);
  coverage.at<float>(1, 2) = 0.25F;
  CHECK(max_coverage(coverage) == 0.25F);
}

TEST_CASE("the box is the one that OpenCV finds around the pixels that count") {
  int with_box = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const cv::Rect rect(int(seed) - 100, 7, 1 + int(seed % 23), 1 + int(seed % 17));
    const cv::Mat coverage = some_coverage(rect.width, rect.height, seed, 0.02);
    const cv::Mat counts = coverage >= kLeast;
    const auto box = covered_box(coverage, rect, kLeast);
    REQUIRE(box.has_value() == (cv::countNonZero(counts) > 0));
    if (!box) continue;
    CHECK(*box == cv::boundingRect(counts) + rect.tl());
    const cv::Mat pixels = covered_pixels(coverage, rect, kLeast, *box);
    CHECK(pixels.type() == CV_8UC1);
    CHECK(pixels.size() == box->size());
    CHECK(cv::countNonZero(pixels != counts(*box - rect.tl())) == 0);
    ++with_box;
  }
  CHECK(with_box > 50);
}

TEST_CASE("a body is above or below the horizon where all of it is higher or lower than the camera") {
  const std::vector<glm::vec3> body = cuboid({10, 8, 3});
  const glm::dvec3 up(0, 0, -1);
  const auto side = [&](double down_m, const glm::dquat& turn = {1, 0, 0, 0}) {
    return horizon_side_of(body, CameraFromBody{turn, {500, 40, down_m}}, up);
  };
  CHECK(side(-3.001) == HorizonSide::above);
  CHECK(side(-2.999) == HorizonSide::on);
  CHECK(side(-3) == HorizonSide::on);
  CHECK(side(0) == HorizonSide::on);
  CHECK(side(3) == HorizonSide::on);
  CHECK(side(3.001) == HorizonSide::below);
  CHECK(side(-1e7) == HorizonSide::above);
  // Banked upright, its half span extends up and down.
  const glm::dquat banked = rotation_of(Attitude{.roll_rad = std::numbers::pi / 2});
  CHECK(side(-7.99, banked) == HorizonSide::on);
  CHECK(side(-8.01, banked) == HorizonSide::above);
  CHECK(horizon_side_of({}, CameraFromBody{}, up) == HorizonSide::on);
}

TEST_CASE("what lies on the axis of a camera that is pitched up is above the horizon") {
  // With the camera's pitch, the up vector is tilted back along its axis.
  const double pitch_rad = rad_of_deg(10);
  const glm::dvec3 up = glm::conjugate(rotation_of(Attitude{.pitch_rad = pitch_rad})) * glm::dvec3(0, 0, -1);
  const CameraFromBody ahead{{1, 0, 0, 0}, {1000, 0, 0}};
  CHECK(horizon_side_of(cuboid({10, 10, 10}), ahead, up) == HorizonSide::above);
  const CameraFromBody lower{{1, 0, 0, 0}, {1000, 0, 1000 * std::tan(pitch_rad)}};
  CHECK(horizon_side_of(cuboid({10, 10, 10}), lower, up) == HorizonSide::on);
}

TEST_CASE("a part of a larger coverage is measured alone") {
  const cv::Mat whole = cv::Mat::ones(10, 10, CV_32FC1);
  const cv::Mat part = whole(cv::Rect(3, 4, 2, 5));
  CHECK(covered_box(part, {3, 4, 2, 5}, kLeast) == cv::Rect(3, 4, 2, 5));
  CHECK(area_px(part) == 10);
}

TEST_CASE("the area is the sum of the shares covered") {
  CHECK(area_px(cv::Mat()) == 0);
  CHECK(area_px(cv::Mat(4, 10, CV_32FC1, cv::Scalar(0.25))) == 10);
  // A million small shares: OpenCV adds up in doubles, so nothing is lost but the floats' own 6e-8.
  CHECK(area_px(cv::Mat(1000, 1000, CV_32FC1, cv::Scalar(0.001))) == doctest::Approx(1000).epsilon(1e-7));
}

TEST_CASE("the part outside the image is not hidden") {
  CHECK(occluded_fraction({.visible_fraction = 0.3, .inside_fraction = 0.3}) == 0);
  CHECK(occluded_fraction({.visible_fraction = 1, .inside_fraction = 1}) == 0);
}

TEST_CASE("the hidden share is one of what lies in the image") {
  CHECK(occluded_fraction({.visible_fraction = 0.25, .inside_fraction = 0.5}) == 0.5);
  CHECK(occluded_fraction({.visible_fraction = 0, .inside_fraction = 0.5}) == 1);
}

TEST_CASE("without coverage in the image nothing is hidden, and rounding never leaves 0 to 1") {
  CHECK(occluded_fraction({.visible_fraction = 0, .inside_fraction = 0}) == 0);
  CHECK(occluded_fraction({.visible_fraction = 0.5000001, .inside_fraction = 0.5}) == 0);
}

TEST_CASE("a twentieth hidden is not yet occluded") {
  CHECK_FALSE(is_occluded({.visible_fraction = 0.96, .inside_fraction = 1}));
  CHECK(is_occluded({.visible_fraction = 0.94, .inside_fraction = 1}));
  CHECK_FALSE(is_occluded({.visible_fraction = 0.1, .inside_fraction = 0.1}));
}

TEST_CASE("a nearer layer occludes by its opacity where it covers the farther one") {
  cv::Mat coverage(10, 10, CV_32FC1, cv::Scalar(0.5));
  const cv::Rect rect(20, 20, 10, 10);
  occlude_coverage(coverage, rect, even_layer({25, 18, 10, 6}, {0, 0, 0, 0.75F}));
  for (int y = 20; y < 30; ++y)
    for (int x = 20; x < 30; ++x) {
      const bool under = x >= 25 && y < 24;
      REQUIRE(coverage.at<float>(y - 20, x - 20) == (under ? 0.125F : 0.5F));
    }
  occlude_coverage(coverage, rect, Layer{});
  occlude_coverage(coverage, rect, even_layer({100, 100, 5, 5}, {1, 1, 1, 1}));
  CHECK(coverage.at<float>(9, 9) == 0.5F);
}

}  // namespace sigs::test
