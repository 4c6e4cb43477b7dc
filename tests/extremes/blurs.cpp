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

// The share of a row of pixels' light that falls into column k, of a line of a width about a middle, blurred by a
// Gaussian and then averaged over the pixel: a difference of the Gaussian's second integral.
double share_of_pixel(int k, double middle_px, double width_px, double sigma_px) {
  const auto second = [&](double t) {
    const double z = t / sigma_px;
    return t * 0.5 * (1 + std::erf(z / std::numbers::sqrt2)) +
           sigma_px * std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
  };
  const double right = k + 0.5 - middle_px, left = k - 0.5 - middle_px, half = width_px / 2;
  return second(right + half) - second(left + half) - second(right - half) + second(left - half);
}

// Where the light is, and how far a pixel is from the closed form at most, as a share of the brightest.
struct PlateImage {
  glm::dvec2 middle_px{0, 0};
  double off = 0;
};

PlateImage image_of_plate(const glm::dvec2& at_px, double side_px, double sigma_px) {
  constexpr double kFocal_px = 300;
  const auto metres = [](double px) { return px * kDistance_m / kFocal_px; };
  Scenario scenario;
  add_plate(scenario, metres(side_px),
            kEye_m + glm::dvec3(kDistance_m, metres(at_px.x - 159.5), metres(at_px.y - 119.5)));
  Scene scene = scenario.opened();
  scene.compositing.blur_px_per_m = sigma_px / kDistance_m;
  ComposeContext context;
  const SceneMoment moment = scene_at(scene, 0);
  const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders[0], context);
  REQUIRE(layers);
  const Layer& seen = layers->blurred;
  glm::dvec2 sum(0);
  double all = 0, highest = 0, off = 0;
  for (int y = seen.rect.y; y < seen.rect.br().y; ++y)
    for (int x = seen.rect.x; x < seen.rect.br().x; ++x) {
      const double opacity = seen.color.at<cv::Vec4f>(cv::Point(x, y) - seen.rect.tl())[3];
      const double wanted =
          share_of_pixel(x, at_px.x, side_px, sigma_px) * share_of_pixel(y, at_px.y, side_px, sigma_px);
      sum += opacity * glm::dvec2(x, y);
      all += opacity;
      highest = std::max(highest, wanted);
      off = std::max(off, std::abs(opacity - wanted));
    }
  return {sum / all, off / highest};
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

TEST_CASE(
    "a target's light is where the target is between pixels, and divided among them as a lens does, however small") {
  for (const double sigma_px : {0.45, 1.0})
    for (const double side_px : {0.1, 0.3, 0.6, 1.3, 2.4})
      for (const double phase_px : {0.0, 0.15, 0.3, 0.5, 0.8}) {
        CAPTURE(sigma_px);
        CAPTURE(side_px);
        CAPTURE(phase_px);
        const glm::dvec2 at_px(160 + phase_px, 118.7 - phase_px / 2);
        const PlateImage image = image_of_plate(at_px, side_px, sigma_px);
        CHECK(glm::distance(image.middle_px, at_px) < 0.02);
        CHECK(image.off < 0.03);
      }
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
