// SPDX-License-Identifier: MIT
#include "frame/ground_shadow.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "base/transfer.h"
#include "compositor/blend.h"
#include "frame/look.h"
#include "frame/synthetic_scenes.h"
#include "scene/scene_at.h"

namespace sigs::test {
namespace {

const cv::Size kGroundImage(640, 480);
constexpr double kPlateHigh_m = 20;  // of the plate above the ground
constexpr double kPlateHalf_m = 8;

// A camera 150 m up that looks down by 45 degrees, and a level plate of 16 m where its axis meets the ground, sunlit.
void prepare_ground(Scenario& scenario, double elevation_deg, double azimuth_deg = 0) {
  write_obj(scenario.path("plate.obj"),
            {{{-kPlateHalf_m, -kPlateHalf_m, -0.01}, {kPlateHalf_m, kPlateHalf_m, 0.01}, {0.5, 0.5, 0.5}}}, 1);
  scenario.add("plate.obj", {150, 0, -kPlateHigh_m});
  scenario.project.camera.pitch_deg = -45;
  scenario.project.light.kind = LightKind::sun;
  scenario.project.light.sun = {.azimuth_deg = azimuth_deg, .elevation_deg = elevation_deg};
  scenario.project.light.ground_shadow = 0.6;
  scenario.project.appearance.psf_sigma_px = 0;
}

Frame even_ground(uchar code) {
  Frame frame = even_frame(kGroundImage, code, PixelLayout::gray);
  frame.color.range = ColorRange::full;
  frame.color.transfer = 13;
  return frame;
}

// Of a place on the ground, by the formula of a pinhole that is pitched down by 45 degrees.
cv::Point2d ground_pixel(double x_m, double y_m, double focal_px) {
  const double s = std::sqrt(0.5);
  const double ahead = s * x_m + s * 150, down = s * 150 - s * x_m;
  return {(kGroundImage.width - 1) / 2.0 + focal_px * y_m / ahead,
          (kGroundImage.height - 1) / 2.0 + focal_px * down / ahead};
}

// What of a frame without the body the shadow takes: shares of light, CV_64F.
cv::Mat taken_light(const Scene& scene, const Frame& background, uchar code) {
  const SceneMoment moment = scene_at(scene, 1);
  const GroundShadow shadow =
      ground_shadow(scene, moment, moment.intruders.front(), scene.camera.lens, 0, {{0, 0}, background.size_px()});
  cv::Mat taken = cv::Mat::zeros(background.size_px(), CV_64F);
  Frame image = cloned(background);
  if (!shadow.layer.empty()) blend_over(image, shadow.layer, BlendChoice::linear);
  const double light = linear_of_display(static_cast<float>(code) / 255);
  for (int y = 0; y < taken.rows; ++y)
    for (int x = 0; x < taken.cols; ++x)
      taken.at<double>(y, x) = 1 - linear_of_display(float(image.planes[0].at<uchar>(y, x)) / 255) / light;
  return taken;
}

}  // namespace

TEST_CASE("a shadow lies where the line from the sun meets the ground") {
  const double root = std::sqrt(0.5);
  const auto at = shadow_of({10, 20, -100}, {root, 0, -root});  // the sun 45 degrees high, ahead
  REQUIRE(at);
  CHECK(glm::distance(*at, {-90, 20, 0}) < 1e-9);
  CHECK(glm::distance(*shadow_of({3, 4, -5}, {0, 0, -1}), {3, 4, 0}) < 1e-12);
  CHECK_FALSE(shadow_of({0, 0, 0}, {0, 0, -1}));
  CHECK_FALSE(shadow_of({0, 0, 1}, {0, 0, -1}));
  CHECK_FALSE(shadow_of({0, 0, -1}, {1, 0, 0}));
  CHECK_FALSE(shadow_of({0, 0, -1}, {1, 0, 0.1}));
  CHECK_FALSE(shadow_of({0, NAN, -1}, {0, 0, -1}));
  CHECK_FALSE(shadow_of({0, 0, -1e300}, {1, 0, -1e-300}));
}

TEST_CASE("the shadow of a plate is the quadrilateral that a pinhole sees, as dark as is asked for") {
  for (const double elevation_deg : {90.0, 50.0}) {
    CAPTURE(elevation_deg);
    Scenario scenario(kGroundImage);
    prepare_ground(scenario, elevation_deg);
    const Scene scene = scenario.opened();
    const double focal_px = scene.camera.lens.parameters().fx;
    const cv::Mat taken = taken_light(scene, even_ground(180), 180);
    const double moved_m = elevation_deg == 90 ? 0 : -kPlateHigh_m / std::tan(50 * 3.14159265358979 / 180);
    std::vector<cv::Point2f> corners;
    for (const auto& [x, y] : {std::pair(-1, -1), std::pair(-1, 1), std::pair(1, 1), std::pair(1, -1)})
      corners.emplace_back(ground_pixel(150 + moved_m + x * kPlateHalf_m, y * kPlateHalf_m, focal_px));
    const cv::Moments expected = cv::moments(corners), found = cv::moments(taken);
    CHECK(found.m00 / 0.6 == doctest::Approx(expected.m00).epsilon(0.02));
    CHECK(std::abs(found.m10 / found.m00 - expected.m10 / expected.m00) < 0.1);
    CHECK(std::abs(found.m01 / found.m00 - expected.m01 / expected.m00) < 0.1);
    const cv::Point middle(cvRound(expected.m10 / expected.m00), cvRound(expected.m01 / expected.m00));
    CHECK(taken.at<double>(middle) == doctest::Approx(0.6).epsilon(0.02));
  }
}

TEST_CASE("a shadow takes as much less as haze lets through") {
  Scenario scenario(kGroundImage);
  prepare_ground(scenario, 90);
  const double distance_m = 150 * std::sqrt(2.0);  // of the ground that the camera's axis meets
  const cv::Point middle(kGroundImage.width / 2, kGroundImage.height / 2);
  for (const double visibility_m : {1e7, 600.0}) {
    scenario.project.appearance.haze.visibility_m = visibility_m;
    const cv::Mat taken = taken_light(scenario.opened(), even_ground(180), 180);
    const double through = std::exp(-3 * distance_m / visibility_m);
    CHECK(taken.at<double>(middle) == doctest::Approx(0.6 * through).epsilon(0.03));  // codes are whole
  }
}

TEST_CASE("the sun's disc softens the shadow: from a height of 50 spans hardly anything of it is left") {
  Scenario scenario(kGroundImage);
  prepare_ground(scenario, 90);
  double most = 0;
  for (const double high_m : {20.0, 2500.0, 5000.0}) {
    scenario.project.intruders[0].trajectory.waypoints[0].position_m.z = -high_m;
    const cv::Mat taken = taken_light(scenario.opened(), even_ground(180), 180);
    double now = 0;
    cv::minMaxLoc(taken, nullptr, &now);
    if (most > 0) CHECK(now < 0.95 * most);
    // A disc 46.5 m wide over a plate of 16 m: 256 of 1,700 square metres of sun.
    if (high_m == 5000) CHECK(now == doctest::Approx(0.6 * 0.16).epsilon(0.35));
    most = now;
  }
}

TEST_CASE("no shadow is drawn unless asked for, by a lamp, by night, in thermal footage, or from below the ground") {
  const auto composed_with = [](const std::function<void(Project&)>& change) {
    Scenario scenario(kGroundImage);
    prepare_ground(scenario, 60);
    change(scenario.project);
    return composed(scenario.opened(), 1, even_ground(180));
  };
  const ComposedFrame with = composed_with([](Project&) {});
  CHECK(with.truth.intruders[0].has_shadow);
  const ComposedFrame without = composed_with([](Project& p) { p.light.ground_shadow = 0; });
  CHECK(cv::countNonZero(with.image.planes[0] != without.image.planes[0]) > 100);
  for (const std::function<void(Project&)>& change : std::vector<std::function<void(Project&)>>{
           [](Project& p) { p.light.ground_shadow = 0; }, [](Project& p) { p.light.kind = LightKind::point; },
           [](Project& p) { p.light.sun.elevation_deg = -5; },
           [](Project& p) { p.footage.spectrum = Spectrum::thermal; },
           [](Project& p) { p.compositing.method = MethodChoice::plain; },
           [](Project& p) { p.intruders[0].trajectory.waypoints[0].position_m.z = 1; }})
    CHECK_FALSE(composed_with(change).truth.intruders[0].has_shadow);
}

TEST_CASE("a shadow is no part of the target, and the own body hides it") {
  Scenario scenario(kGroundImage);
  prepare_ground(scenario, 60);
  const ComposedFrame with = composed(scenario.opened(), 1, even_ground(180));
  scenario.project.light.ground_shadow = 0;
  const ComposedFrame without = composed(scenario.opened(), 1, even_ground(180));
  CHECK(with.truth.intruders[0].visible_box == without.truth.intruders[0].visible_box);
  CHECK(with.truth.intruders[0].visible_pixels == without.truth.intruders[0].visible_pixels);
  scenario.project.light.ground_shadow = 0.6;
  Scene hidden = scenario.opened();
  hidden.own_body = cv::Mat::ones(kGroundImage, CV_32FC1);
  const ComposedFrame behind = composed(hidden, 1, even_ground(180));
  CHECK(cv::countNonZero(behind.image.planes[0] != 180) == 0);
}

TEST_CASE("a shadow takes light, not noise: noise stays what it is for its brightness, and sharpening adds none") {
  Scenario scenario(kGroundImage);
  scenario.project.appearance.psf_sigma_px = 0;
  for (const int transfer : {1, 13, 16, 18}) {  // BT.709, sRGB, PQ, HLG
    CAPTURE(transfer);
    Frame noisy = even_ground(150);
    noisy.color.transfer = transfer;
    cv::Mat noise(kGroundImage, CV_32F);
    cv::RNG(4).fill(noise, cv::RNG::NORMAL, 150, 4);
    noise.convertTo(noisy.planes[0], CV_8U);
    const auto sd_under_shadow = [&](double sharpening, double grain) {
      Scene scene = scenario.opened();
      scene.appearance.sharpening = sharpening;
      scene.appearance.sharpening_px = 1;
      scene.appearance.grain = {.sd_dark = grain, .sd_bright = grain};
      const Layer shadow{.rect = {{0, 0}, kGroundImage},
                         .color = cv::Mat(kGroundImage, CV_32FC4, cv::Scalar(0, 0, 0, 0.7))};
      ComposedFrame frame{.image = cloned(noisy), .mask = cv::Mat::zeros(kGroundImage, CV_8UC1)};
      (void)blend_with_post_blend_stages(frame, scene, shadow, BlendChoice::linear, 1, 0, {});
      cv::Scalar mean, sd;
      cv::meanStdDev(frame.image.planes[0], mean, sd);
      return sd[0];
    };
    const double plain = sd_under_shadow(0, 0);
    CHECK(plain > 1);
    // The footage's noise has been sharpened by its camera, and noise is made for what the shadow takes of it.
    CHECK(sd_under_shadow(1, 0) == doctest::Approx(plain).epsilon(0.03));
    CHECK(sd_under_shadow(0, 4) == doctest::Approx(std::max(plain, 4.0)).epsilon(0.04));
  }
}

}  // namespace sigs::test
