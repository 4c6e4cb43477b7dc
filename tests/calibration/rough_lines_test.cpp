// SPDX-License-Identifier: MIT
#include "calibration/rough_lines.h"

#include <doctest/doctest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "calibration/made_tracks.h"

namespace sigs::test {
namespace {

constexpr cv::Size kImage_px(960, 540);

// A wall of bright and dark panels, seen through a lens; `bend` bends the edges of the wall itself in one direction.
cv::Mat wall(const Camera& camera, double roll_rad, double bend) {
  cv::Mat image(camera.size_px, CV_32F);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      float sum = 0;
      for (int part = 0; part < 9; ++part) {
        const auto ray = camera.lens.ray({x + (part % 3 - 1) / 3.0, y + (part / 3 - 1) / 3.0});
        if (!ray || !(ray->x > 0)) continue;
        const double u = ray->y / ray->x;
        const double v = ray->z / ray->x;
        const double across = std::cos(roll_rad) * u - std::sin(roll_rad) * v;
        const double down = std::sin(roll_rad) * u + std::cos(roll_rad) * v + bend * across * across;
        const int panels = static_cast<int>(std::floor(across / 0.31)) + static_cast<int>(std::floor(down / 0.19));
        sum += panels % 2 == 0 ? 200.0F : 60.0F;
      }
      image.at<float>(y, x) = sum / 9;
    }
  cv::GaussianBlur(image, image, {}, 0.6);
  cv::Mat noise(image.size(), CV_32F);
  cv::RNG chance(7);
  chance.fill(noise, cv::RNG::NORMAL, 0, 1.5);
  image += noise;
  image.convertTo(image, CV_8U);
  return image;
}

LinesAnswer lines_of(const Camera& camera, double bend) {
  LinesRoad road;
  for (int i = 0; i < 4; ++i) road.add(i, wall(camera, 0.2 * i + 0.05, bend));
  return road.answer();
}

// The distortion of the division model whose pixels are those of the lens: from the angle of the corner.
double division_of(const Camera& camera) {
  const double radius_px = std::hypot(camera.size_px.width, camera.size_px.height) / 2;
  const double share = 0.7;  // of the radius, about where the edges lie
  const glm::dvec2 at(camera.lens.parameters().cx + share * radius_px, camera.lens.parameters().cy);
  const auto ray = camera.lens.ray(at);
  REQUIRE(ray);
  return (share * radius_px / camera.lens.parameters().fx * ray->x / std::hypot(ray->y, ray->z) - 1) / (share * share);
}

}  // namespace

TEST_CASE("straight edges show the distortion of the lens, and none where there is none") {
  for (const double k1 : {-0.2, -0.08, 0.0, 0.08}) {
    CAPTURE(k1);
    const Camera camera = made_camera(kImage_px, LensModel::brown_conrady, 800, k1);
    const LinesAnswer found = lines_of(camera, 0);
    REQUIRE_MESSAGE(found.is_certain, found.reason);
    CAPTURE(found.distortion);
    CHECK(std::abs(found.distortion - division_of(camera)) < std::max(0.02, 3 * found.sd));
  }
}

TEST_CASE("an image without long edges shows no distortion") {
  LinesRoad road;
  road.add(0, cv::Mat(kImage_px, CV_8UC1, cv::Scalar(90)));
  cv::Mat noise(kImage_px, CV_8UC1);
  cv::RNG chance(3);
  chance.fill(noise, cv::RNG::UNIFORM, 0, 255);
  road.add(1, noise);
  CHECK_FALSE(road.answer().is_certain);
  CHECK_FALSE(LinesRoad().answer().is_certain);
}

TEST_CASE("edges of images smaller than any edge, or of another type, are none") {
  CHECK(long_edges(cv::Mat(), 0.1).empty());
  CHECK(long_edges(cv::Mat(4, 4, CV_8UC1, cv::Scalar(1)), 0.1).empty());
  CHECK(long_edges(cv::Mat(90, 90, CV_32F, cv::Scalar(1)), 0.1).empty());
}

}  // namespace sigs::test
