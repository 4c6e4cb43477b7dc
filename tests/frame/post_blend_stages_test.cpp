// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "frame/synthetic_scenes.h"
#include "scene/scene_at.h"

namespace sigs::test {
namespace {

AppearanceSettings everything() {
  AppearanceSettings look{.psf_sigma_px = 0.5,
                          .sharpening = 1.2,
                          .sharpening_px = 1.1,
                          .chroma_blur_px = 1.2,
                          .black = 0.02,
                          .saturation = 0.7};
  look.grain = {.sd_dark = 2,
                .sd_bright = 3,
                .sd_chroma = 2,
                .correlation_length_px = 0.8,
                .temporal_correlation = 0.5,
                .seed = 5};
  look.haze.visibility_m = 4000;
  return look;
}

// Two aircraft, the nearer in part in front of the farther, both in motion.
Scene full_scene(const Scenario& scenario) {
  Scene scene = scenario.opened();
  scene.appearance = everything();
  scene.motion.exposures = {{0, 0.02}};
  scene.motion.attitudes = {{0, rotation_of({0, 0, 0})}, {0.1, rotation_of({0.01, 0.02, 0.05})}};
  return scene;
}

void add_two(Scenario& scenario) {
  add_aircraft(scenario, {60, 2, -151});
  add_aircraft(scenario, {90, 0, -150});
}

Scene over_body(Scene scene, const cv::Rect& body) {
  scene.own_body = cv::Mat::zeros(scene.footage.size_px, CV_32FC1);
  scene.own_body(body).setTo(1);
  return scene;
}

void check_outside(const Frame& before, const ComposedFrame& after) {
  const cv::Size step = chroma_step(before.layout);
  for (int plane = 0; plane < before.plane_count(); ++plane) {
    const auto index = static_cast<std::size_t>(plane);
    const cv::Size s = plane == 0 ? cv::Size(1, 1) : step;
    for (int y = 0; y < before.planes[index].rows; ++y)
      for (int x = 0; x < before.planes[index].cols; ++x) {
        const cv::Rect pixels =
            cv::Rect(x * s.width, y * s.height, s.width, s.height) & cv::Rect({0, 0}, after.mask.size());
        if (cv::countNonZero(after.mask(pixels)) > 0) continue;
        REQUIRE(before.planes[index].at<uchar>(y, x) == after.image.planes[index].at<uchar>(y, x));
      }
  }
}

}  // namespace

TEST_CASE("with all stages a frame is the same on every thread, by itself and after others") {
  Scenario scenario;
  add_two(scenario);
  const Scene scene = full_scene(scenario);
  const Frame background = grainy_frame(scenario.size_px(), 2);
  const ComposedFrame alone = composed(scene, 2, background);
  std::array<Frame, 4> frames;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < frames.size(); ++i)
    threads.emplace_back([&, i] {
      ComposeContext context;
      for (const int number : {0, 1, 2}) {
        if (i % 2 == 0 && number < 2) continue;
        Result<ComposedFrame> frame = compose_frame(scene, number, background, context);
        if (frame) frames[i] = frame->image;
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const Frame& frame : frames) {
    REQUIRE(frame.size_px() == scenario.size_px());
    CHECK(same_planes(frame, alone.image));
  }
}

TEST_CASE("all stages touch only what the mask says, in every layout, at the edges of the image too") {
  for (const PixelLayout layout :
       {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
    for (const glm::dvec3 place : {glm::dvec3(60, 0, -150), glm::dvec3(60, 32, -174), glm::dvec3(20, -10, -150)}) {
      CAPTURE(static_cast<int>(layout));
      Scenario scenario({321, 239});
      add_aircraft(scenario, place);
      const Scene scene = full_scene(scenario);
      const Frame background = grainy_frame(scenario.size_px(), 1, layout);
      const ComposedFrame frame = composed(scene, 1, background);
      REQUIRE(!frame.mask.empty());
      check_outside(background, frame);
      CHECK(cv::countNonZero(frame.mask) > 100);
    }
}

TEST_CASE("the own body's samples keep their bits under all stages") {
  Scenario scenario;
  add_two(scenario);
  const cv::Rect body(150, 0, 170, 240);
  const Scene scene = over_body(full_scene(scenario), body);
  const Frame background = grainy_frame(scenario.size_px(), 1);
  const ComposedFrame frame = composed(scene, 1, background);
  CHECK(same_bytes(background.planes[0](body).clone(), frame.image.planes[0](body).clone()));
  const cv::Rect chroma(76, 0, 84, 120);  // column 75 lies on pixel 150 and has a quarter of pixel 149
  for (const std::size_t plane : {1U, 2U})
    CHECK(same_bytes(background.planes[plane](chroma).clone(), frame.image.planes[plane](chroma).clone()));
  CHECK(!same_planes(background, frame.image));
}

TEST_CASE("the truth does not depend on the look") {
  Scenario scenario;
  add_aircraft(scenario, {60, 2, -151});
  const Scene plain = scenario.opened();
  Scene looked = plain;
  looked.appearance = everything();
  looked.motion.exposures = {{0, 0.02}};
  const Frame background = grainy_frame(scenario.size_px(), 1);
  const IntruderTruth before = composed(plain, 1, background).truth.intruders.front();
  const IntruderTruth after = composed(looked, 1, background).truth.intruders.front();
  CHECK(after.amodal_box == before.amodal_box);
  CHECK(after.visible_box == before.visible_box);
  CHECK(after.visible_pixels == before.visible_pixels);
  CHECK(after.visible_fraction == doctest::Approx(before.visible_fraction));
}

TEST_CASE("the methods of the paper ignore the look and the exposure") {
  for (const MethodChoice method : {MethodChoice::classic, MethodChoice::plain}) {
    Scenario scenario;
    add_aircraft(scenario, {60, 2, -151});
    scenario.project.compositing.method = method;
    const Scene plain = scenario.opened();
    Scene looked = full_scene(scenario);
    looked.motion.attitudes = plain.motion.attitudes;
    const Frame background = grainy_frame(scenario.size_px(), 1);
    CHECK(same_planes(composed(plain, 1, background).image, composed(looked, 1, background).image));
  }
}

TEST_CASE("amounts of zero leave a stage out whatever its other settings are") {
  Scenario scenario;
  add_two(scenario);
  const Scene plain = scenario.opened();
  Scene looked = plain;
  looked.appearance.sharpening_px = 5;
  looked.appearance.grain = {.correlation_length_px = 3, .temporal_correlation = 0.9, .seed = 77};
  looked.appearance.haze.airlight_color = {9, 9, 9};
  looked.motion.exposures = {{0, 1e-5}};  // 0.001 px
  const Frame background = grainy_frame(scenario.size_px(), 1);
  const ComposedFrame before = composed(plain, 1, background);
  const ComposedFrame after = composed(looked, 1, background);
  CHECK(same_planes(before.image, after.image));
  CHECK(same_bytes(before.mask, after.mask));
  CHECK(before.op_counts == after.op_counts);
}

TEST_CASE("a nearer aircraft shows nothing of a farther one behind it, sharpened or not") {
  // A wall that hides the farther one wholly: with and without it the same.
  const auto with_wall = [](bool has_other) {
    Scenario scenario;
    write_obj(scenario.path("wall.obj"), {{{-1, -30, -30}, {1, 30, 30}}}, 1);
    scenario.add("wall.obj", {60, 0, -150});
    if (has_other) add_aircraft(scenario, {90, 0, -150});
    Scene scene = scenario.opened();
    scene.appearance.sharpening = 2;
    scene.appearance.chroma_blur_px = 1.5;
    scene.appearance.psf_sigma_px = 0.45;
    return composed(scene, 1, grainy_frame(scenario.size_px(), 1));
  };
  const ComposedFrame alone = with_wall(false);
  const ComposedFrame before_other = with_wall(true);
  // What the farther one leaves before it is hidden is rounded once more: a code at most.
  for (std::size_t plane = 0; plane < 3; ++plane)
    CHECK(cv::norm(alone.image.planes[plane], before_other.image.planes[plane], cv::NORM_INF) <= 1);
}

TEST_CASE("a look is finite in the thickest haze, at the camera and at the end of the world") {
  for (const glm::dvec3 place : {glm::dvec3(0, 0, -150), glm::dvec3(1, 0.3, -150), glm::dvec3(1e7, 1e5, -150)})
    for (const double visibility_m : {1.0, 1e7}) {
      CAPTURE(place.x);
      CAPTURE(visibility_m);
      Scenario scenario;
      add_aircraft(scenario, place);
      Scene scene = full_scene(scenario);
      scene.appearance.haze.visibility_m = visibility_m;
      scene.motion.exposures = {{0, 1}};
      const SceneMoment moment = scene_at(scene, 1);
      ComposeContext context;
      const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders[0], context);
      REQUIRE(layers.has_value());
      if (layers->occluded.empty()) continue;
      CHECK(cv::checkRange(layers->occluded.color));
      double low = 0;
      double high = 0;
      cv::minMaxIdx(layers->occluded.color.reshape(1), &low, &high);
      CHECK(low >= 0);
    }
}

TEST_CASE("a rolling shutter's motion blur lies along the way that its image moves") {
  Scenario scenario;
  add_aircraft(scenario, {60, 0, -150});
  Scene scene = scenario.opened();
  // 1 rad/s of pitch: 300 px/s downwards, 6 px in 20 ms; a point that moves with the rows is read later and moves more.
  scene.motion.attitudes = {{-1, rotation_of({0, -1, 0})}, {1, rotation_of({0, 1, 0})}};
  scene.motion.exposures = {{0, 0.02}};
  scene.footage.times_s = {0, 0, 0};
  const auto motion_with = [&](double readout_s) {
    scene.motion.readout_s = readout_s;
    const SceneMoment moment = scene_at(scene, 1);
    ComposeContext context;
    const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders[0], context);
    REQUIRE(layers.has_value());
    double yy = 0;
    for (const MotionKernel::Shift& shift : layers->motion.shifts)
      yy += double{shift.weight} * std::pow(shift.by_px.y, 2);
    return std::sqrt(12 * yy);
  };
  const double all_at_once = motion_with(0);
  CHECK(all_at_once == doctest::Approx(6).epsilon(0.01));
  // Row speed 239 rows in 0.1 s = 2390 px/s: the image moves by 300 / (1 - 300 / 2390) px/s.
  CHECK(motion_with(0.1) == doctest::Approx(all_at_once / (1 - 300.0 / 2390)).epsilon(0.02));
}

TEST_CASE("each stage that is on is kept under its name, and none that is off") {
  Scenario scenario;
  add_aircraft(scenario, {60, 2, -151});
  const auto names_of = [&](const Scene& scene) {
    ComposeContext context;
    const Result<ComposedFrame> frame =
        compose_frame(scene, 1, grainy_frame(scenario.size_px(), 1), context, Stages::keep);
    REQUIRE(frame.has_value());
    std::vector<std::string> names;
    for (const Stage& stage : frame->stages) names.push_back(stage.name);
    return names;
  };
  CHECK(names_of(scenario.opened()) ==
        std::vector<std::string>{"input1", "layer", "warped", "blurred", "occluded", "mask", "output"});
  CHECK(names_of(full_scene(scenario)) == std::vector<std::string>{"input1", "layer", "warped", "hazed",
                                                                   "motion_blurred", "blurred", "occluded", "sharpened",
                                                                   "chroma_blur", "grain", "mask", "output"});
}

TEST_CASE("the stages' work follows the intruder and not the image") {
  const auto counts_in = [](cv::Size size_px) {
    Scenario scenario(size_px);
    write_calibration(scenario.path("lens.xml"), {300, 0, 159.5, 0, 300, 119.5, 0, 0, 1}, {0, 0, 0, 0, 0}, size_px);
    scenario.project.footage.calibration = "lens.xml";
    add_aircraft(scenario, {60, 0, -150});
    return composed(full_scene(scenario), 1, even_frame(size_px, 100)).op_counts;
  };
  const OpCounts small = counts_in({320, 240});
  const OpCounts large = counts_in({1280, 960});
  CHECK(small.samples_filtered == large.samples_filtered);
  CHECK(small.samples_of_noise == large.samples_of_noise);
  CHECK(small.pixels_motion_blurred == large.pixels_motion_blurred);
  CHECK(small.samples_filtered > 500);
  CHECK(small.samples_of_noise > 500);
  CHECK(small.pixels_motion_blurred > 500);
}

}  // namespace sigs::test
