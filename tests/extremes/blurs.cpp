// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "extremes/validity.h"

namespace sigs::test {
namespace {

constexpr double kDistance_m = 60;

// The scenario's intruders, blurred by so much.
ValidFrame blurred_by(double sigma_px, Scene scene, uchar luma = 100) {
  scene.compositing.blur_px_per_m = sigma_px / kDistance_m;
  return valid_frame(scene, 1, even_frame(scene.footage.size_px, luma));
}

Scene aircraft_ahead() {
  Scenario scenario;
  add_aircraft(scenario, kEye_m + glm::dvec3(kDistance_m, 0, 0));
  return scenario.opened();
}

}  // namespace

TEST_CASE("a blur of a millionth of a pixel is no blur, bit for bit") {
  const Scene scene = aircraft_ahead();
  const ValidFrame sharp = blurred_by(0, scene);
  const ValidFrame soft = blurred_by(1e-6, scene);
  CHECK(!sharp.composed.mask.empty());
  CHECK(same_planes(sharp.composed.image, soft.composed.image));
  CHECK(same_bytes(sharp.composed.mask, soft.composed.mask));
  CHECK(sharp.composed.truth.intruders[0].visible_box == soft.composed.truth.intruders[0].visible_box);
}

TEST_CASE("a blur of a third of a pixel keeps the light and barely moves any pixel") {
  const Scene scene = aircraft_ahead();
  const ValidFrame sharp = blurred_by(0, scene);
  const ValidFrame soft = blurred_by(0.3, scene);
  const cv::Scalar before = cv::sum(sharp.layers[0].warped.color);
  const cv::Scalar after = cv::sum(soft.layers[0].blurred.color);
  for (int c = 0; c < 4; ++c) CHECK(after[c] == doctest::Approx(before[c]).epsilon(0.001));
  // The Gaussian at the neighbours' centres is exp(-1 / (2 * 0.09)) = 0.0039 of that at the pixel's own; sampled, or
  // taken over whole pixels (0.048 each way), a pixel loses no more than a fifth.
  cv::Mat opacity_sharp;
  cv::Mat opacity_soft;
  cv::extractChannel(sharp.layers[0].blurred.color, opacity_sharp, 3);
  cv::extractChannel(soft.layers[0].blurred.color, opacity_soft, 3);
  const cv::Rect shared = sharp.layers[0].blurred.rect & soft.layers[0].blurred.rect;
  CHECK(cv::norm(opacity_sharp(shared - sharp.layers[0].blurred.rect.tl()),
                 opacity_soft(shared - soft.layers[0].blurred.rect.tl()), cv::NORM_INF) < 0.2);
  CHECK(cv::norm(opacity_sharp(shared - sharp.layers[0].blurred.rect.tl()),
                 opacity_soft(shared - soft.layers[0].blurred.rect.tl()), cv::NORM_INF) > 0.001);
}

TEST_CASE("a blur of 500 px spreads the intruder as its closed form says") {
  // Against sigma the plate of 60 px is a point: its opacity is its area times the Gaussian, cut at three sigmas.
  Scenario scenario;
  add_plate(scenario, 12, kEye_m + glm::dvec3(kDistance_m, 0, 0));
  const double sigma_px = 500;
  const ValidFrame valid = blurred_by(sigma_px, scenario.opened(), 16);
  const Layer& soft = valid.layers[0].blurred;
  REQUIRE(!soft.empty());
  CHECK(soft.rect == cv::Rect({0, 0}, scenario.size_px()));
  const double kept = std::pow(std::erf(3 / std::numbers::sqrt2), 2);
  const double peak = 3600 / (2 * std::numbers::pi * sigma_px * sigma_px) / kept;
  for (const cv::Point& pixel : {cv::Point(160, 120), cv::Point(0, 0), cv::Point(319, 0), cv::Point(40, 200)}) {
    const double off_px = std::hypot(pixel.x - 159.5, pixel.y - 119.5);
    const double wanted = peak * std::exp(-0.5 * off_px * off_px / (sigma_px * sigma_px));
    CHECK(soft.color.at<cv::Vec4f>(pixel)[3] == doctest::Approx(wanted).epsilon(0.02));
  }
}

TEST_CASE("whatever the blur everything is valid with every method") {
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain})
    for (const double sigma_px : {0.0, 1e-300, 1e-6, 0.05, 0.3, 1.0, 15.999, 16.001, 500.0, 600.0, 1e6, 1e12}) {
      if (method == MethodChoice::plain && sigma_px > 0) continue;  // it knows no blur
      CAPTURE(static_cast<int>(method));
      CAPTURE(sigma_px);
      Scenario scenario({160, 120});
      scenario.project.compositing.method = method;
      add_aircraft(scenario, kEye_m + glm::dvec3(kDistance_m, 12, 8));  // partly beyond the image's corner
      (void)blurred_by(sigma_px, scenario.opened());
    }
}

}  // namespace sigs::test
