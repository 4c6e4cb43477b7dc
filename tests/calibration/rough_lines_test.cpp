// SPDX-License-Identifier: MIT
#include "calibration/rough_lines.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "calibration/made_tracks.h"

namespace sigs::test {
namespace {

const cv::Size kImage_px(640, 360);

// What each pixel sees of a wall at the distance 1: columns and rows of a CV_64FC2.
cv::Mat_<cv::Vec2d> wall_places(const Camera& camera) {
  cv::Mat_<cv::Vec2d> places(camera.size_px, cv::Vec2d(0, 0));
  for (int y = 0; y < places.rows; ++y)
    for (int x = 0; x < places.cols; ++x)
      if (const auto ray = camera.lens.ray({x, y}); ray && ray->x > 0)
        places(y, x) = {ray->y / ray->x, ray->z / ray->x};
  return places;
}

// A wall of bright and dark panels, whose borders are straight, rolled.
cv::Mat wall(const cv::Mat_<cv::Vec2d>& places, double roll_rad) {
  cv::Mat_<double> image(places.size());
  const auto panels = [](double at, double width) { return std::tanh(30 * std::sin(std::numbers::pi * at / width)); };
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double u = places(y, x)[0];
      const double v = places(y, x)[1];
      const double across = std::cos(roll_rad) * u - std::sin(roll_rad) * v;
      const double down = std::sin(roll_rad) * u + std::cos(roll_rad) * v;
      image(y, x) = 130 + 70 * panels(across, 0.31) * panels(down, 0.19);
    }
  cv::Mat noise(image.size(), CV_64F);
  cv::RNG chance(7);
  chance.fill(noise, cv::RNG::NORMAL, 0, 1.5);
  cv::Mat rounded;
  cv::Mat(image + noise).convertTo(rounded, CV_8U);
  return rounded;
}

LinesAnswer lines_of(const Camera& camera) {
  LinesRoad road;
  const cv::Mat_<cv::Vec2d> places = wall_places(camera);
  for (int i = 0; i < 3; ++i) road.add(i, wall(places, 0.2 * i + 0.05));
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
  for (const double k1 : {-0.2, 0.0, 0.08}) {
    CAPTURE(k1);
    const Camera camera = made_camera(kImage_px, LensModel::brown_conrady, 533, k1);
    const LinesAnswer found = lines_of(camera);
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
