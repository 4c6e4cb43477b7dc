// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "camera/example_lenses.h"
#include "camera/lens.h"
#include "reference/opencv_lens.h"

namespace sigs::test {
namespace {

// The tolerance of Lens::ray, or the last digits where the pixel is large.
double promised_px(const glm::dvec2& pixel) {
  return 1e-9 + 1e-13 * glm::length(pixel);
}

std::vector<glm::dvec2> pixels_over(cv::Size size, int step) {
  std::vector<glm::dvec2> pixels;
  for (int y = 0; y < size.height; y += step)
    for (int x = 0; x < size.width; x += step) pixels.emplace_back(x, y);
  for (const double x : {-0.5, size.width - 0.5})
    for (const double y : {-0.5, size.height - 0.5}) pixels.emplace_back(x, y);
  return pixels;
}

}  // namespace

TEST_CASE("a pixel undistorted and distorted again comes back") {
  for (const ExampleLens& example : all_lenses()) {
    INFO(example.name);
    int rays = 0;
    for (const glm::dvec2& pixel : pixels_over(example.size_px, 9)) {
      const auto ray = example.lens.ray(pixel);
      if (!ray) continue;
      ++rays;
      REQUIRE(std::abs(glm::length(*ray) - 1) < 1e-15);  // rounding of the square root
      REQUIRE(angle_between(*ray, {1, 0, 0}) <= example.lens.valid_angle_rad());
      const auto back = example.lens.pixel(*ray);
      REQUIRE(back.has_value());
      REQUIRE(glm::distance(*back, pixel) < promised_px(pixel));
    }
    CHECK(rays > 100);
  }
}

TEST_CASE("every direction in the field is recovered from its pixel") {
  for (const ExampleLens& example : all_lenses()) {
    INFO(example.name);
    for (const glm::dvec3& at : directions_over(example.lens, 40, 24, 0.9999)) {
      const auto pixel = example.lens.pixel(at);
      REQUIRE(pixel.has_value());
      const auto ray = example.lens.ray(*pixel);
      REQUIRE(ray.has_value());
      // At a share of 0.9999 of the way to a fold the map is flat to some 1e-4, which costs four of fifteen digits.
      REQUIRE(angle_between(*ray, at) < 1e-10);
    }
  }
}

TEST_CASE("lenses of random coefficients recover every direction in their field from its pixel") {
  std::mt19937 random(20240817);
  constexpr std::array<std::size_t, 5> kCounts{4, 5, 8, 12, 14};
  for (int trial = 0; trial < 200; ++trial) {
    const double size = std::pow(10.0, std::uniform_real_distribution(-3.0, 0.5)(random));
    std::normal_distribution number(0.0, size);
    std::vector<double> coefficients(kCounts[trial % kCounts.size()]);
    for (double& c : coefficients) c = std::clamp(number(random), -3.0, 3.0);
    for (std::size_t tilt = 12; tilt < coefficients.size(); ++tilt) coefficients[tilt] *= 0.3;
    const Lens lens = lens_of(LensModel::brown_conrady, 500, 500, {320, 240}, coefficients);
    INFO(trial);
    for (const glm::dvec3& at : directions_over(lens, 12, 24, 0.999)) {
      const auto pixel = lens.pixel(at);
      REQUIRE(pixel.has_value());
      const auto ray = lens.ray(*pixel);
      REQUIRE(ray.has_value());
      REQUIRE(angle_between(*ray, at) < 1e-9);  // flat to 1e-3 near a fold, and far out towards 90 degrees
    }
  }
}

TEST_CASE("no direction in the field is projected to a pixel without a ray") {
  for (const ExampleLens& example : all_lenses()) {
    std::vector<glm::dvec2> unmet;
    for (const glm::dvec2& pixel : pixels_over(example.size_px, 24))
      if (!example.lens.ray(pixel)) unmet.push_back(pixel);
    if (unmet.empty()) continue;
    INFO(example.name);
    // The field's rim in the image, finely; a pixel with a ray lies inside it.
    std::vector<cv::Point2f> rim;
    for (int i = 0; i < 7200; ++i) {
      const auto edge =
          example.lens.pixel(direction(example.lens.valid_angle_rad() * (1 - 1e-9), 2 * std::numbers::pi * i / 7200));
      if (edge) rim.emplace_back(static_cast<float>(edge->x), static_cast<float>(edge->y));
    }
    REQUIRE(rim.size() == 7200);
    for (const glm::dvec2& pixel : unmet) {
      const cv::Point2f at(static_cast<float>(pixel.x), static_cast<float>(pixel.y));
      CHECK(cv::pointPolygonTest(rim, at, true) < 0.01);  // single precision, and the rim's last billionth
    }
  }
}

TEST_CASE("rays agree with those of OpenCV where its iteration converges") {
  for (const ExampleLens& example : all_lenses()) {
    const LensParameters& l = example.lens.parameters();
    INFO(example.name);
    const truth::OpencvLens opencv(l);
    if (!opencv.is_opencvs()) continue;
    const bool is_fisheye = l.model == LensModel::kannala_brandt;  // it does not converge better with more steps
    const cv::TermCriteria criteria(cv::TermCriteria::COUNT | (is_fisheye ? cv::TermCriteria::EPS : 0),
                                    is_fisheye ? 10 : 500, is_fisheye ? 1e-8 : 0);
    int compared = 0;
    for (const glm::dvec2& pixel : pixels_over(example.size_px, 31)) {
      const auto ray = example.lens.ray(pixel);
      const std::vector<cv::Point2d> out = opencv.tangents({{pixel.x, pixel.y}}, criteria);
      const glm::dvec3 theirs = glm::normalize(glm::dvec3{1, out[0].x, out[0].y});
      if (angle_between(theirs, {1, 0, 0}) >= example.lens.valid_angle_rad()) continue;
      if (!(glm::distance(opencv_pixels(example.lens, {theirs})[0], pixel) < 1e-6)) continue;  // it did not converge
      REQUIRE(ray.has_value());
      REQUIRE(angle_between(*ray, theirs) < 1e-6);  // 1e-6 px of theirs, near a fold some hundred times that in angle
      ++compared;
    }
    const bool far_off_axis = example.name == "principal point outside";
    CHECK(compared > (far_off_axis ? 0 : 10));
  }
}

TEST_CASE("a pixel beyond any image has a ray or none but never a wrong one") {
  for (const ExampleLens& example : example_lenses()) {
    INFO(example.name);
    for (const double far : {1e4, 1e6, 1e9, 1e15, 1e100, 1e300})
      for (const glm::dvec2& toward : {glm::dvec2{1, 0}, glm::dvec2{-1, 0.3}, glm::dvec2{0.2, -1}}) {
        const auto ray = example.lens.ray(far * toward);
        if (!ray) continue;
        const auto back = example.lens.pixel(*ray);
        REQUIRE(back.has_value());
        const glm::dvec2 apart = *back - far * toward;
        // Near a pole of the denominator the last digit of the ray amounts to many pixels.
        const double last_digit_px = 1e-14 * example.lens.pixels_per_radian(*ray);
        CHECK(std::hypot(apart.x, apart.y) < promised_px(far * toward) + last_digit_px);
      }
  }
}

}  // namespace sigs::test
