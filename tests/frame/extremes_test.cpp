// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

// Every number of a truth that goes into a file.
bool is_finite(const IntruderTruth& truth) {
  bool fine = std::isfinite(truth.visible_fraction) && truth.visible_fraction >= 0 && truth.visible_fraction <= 1;
  for (int i = 0; i < 3; ++i) fine = fine && std::isfinite(truth.position_m[i]);
  if (truth.amodal_box)
    fine = fine && std::isfinite(truth.amodal_box->x) && std::isfinite(truth.amodal_box->y) &&
           truth.amodal_box->width >= 0 && truth.amodal_box->height >= 0 && std::isfinite(truth.amodal_box->width) &&
           std::isfinite(truth.amodal_box->height);
  return fine;
}

// A synthetic 200 degree fisheye.
void see_nearly_all(Scenario& scenario) {
  write_calibration(scenario.path("wide.xml"), {180, 0, 319.5, 0, 180, 239.5, 0, 0, 1}, {0, 0, 0, 0}, {640, 480}, true);
  scenario.project.footage.calibration = "wide.xml";
}

}  // namespace

TEST_CASE("an intruder behind the camera is nowhere in the image") {
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain}) {
    Scenario scenario;
    scenario.project.compositing.method = method;
    add_aircraft(scenario, {-80, 5, -145});
    const Frame background = grainy_frame(scenario.size_px(), 1);
    ComposeContext context;
    const Scene scene = scenario.opened();
    const Result<ComposedFrame> frame = compose_frame(scene, 1, background, context);
    REQUIRE(frame.has_value());
    const IntruderTruth& truth = frame->truth.intruders.front();
    CHECK(!truth.in_image);
    CHECK(!truth.amodal_box);
    CHECK(!truth.visible_box);
    CHECK(truth.visible_fraction == 0);
    CHECK(truth.position_m == glm::dvec3(-80, 5, 5));
    CHECK(same_planes(frame->image, background));
    CHECK(frame->mask.empty());
    CHECK(context.renderer_description() == "");  // no OpenGL was made
  }
}

TEST_CASE("an intruder beside the image has a silhouette outside it and is not in it") {
  Scenario scenario;
  add_aircraft(scenario, {100, 80, -150});
  const ComposedFrame frame = composed(scenario);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(!truth.in_image);
  CHECK(!truth.visible_box);
  REQUIRE(truth.amodal_box);
  CHECK(truth.amodal_box->x > 320);
  CHECK(frame.mask.empty());
}

TEST_CASE("a face half a metre ahead fills the image") {
  Scenario scenario;
  write_obj(scenario.path("cube.obj"), {{{-6, -6, -6}, {6, 6, 6}}}, 4);
  scenario.add("cube.obj", {6.5, 0, -150});
  const ComposedFrame frame = composed(scenario);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(cv::countNonZero(frame.mask == 255) == scenario.size_px().area());
  CHECK(truth.visible_box == cv::Rect({0, 0}, scenario.size_px()));
  CHECK(truth.in_image);
  CHECK(is_finite(truth));
  // 12 m at 0.5 m: 7200 px each way, of which the image holds 320 by 240; measured in 256 steps across.
  CHECK(truth.visible_fraction == doctest::Approx(320.0 * 240 / (7200.0 * 7200)).epsilon(0.03));
  CHECK(truth.amodal_box->width == doctest::Approx(7200));
}

TEST_CASE("an aircraft half a metre ahead is drawn") {
  for (const bool wide : {false, true}) {
    CAPTURE(wide);
    Scenario scenario(wide ? cv::Size(640, 480) : cv::Size(320, 240));
    if (wide) see_nearly_all(scenario);
    scenario.project.compositing.supersampling = 1;  // six large faces
    add_aircraft(scenario, {6.5, 0, -150});          // the tail is 0.5 m ahead
    const ComposedFrame frame = composed(scenario);
    CHECK(frame.truth.intruders.front().in_image);
    CHECK(is_finite(frame.truth.intruders.front()));
    CHECK(frame.mask.at<uchar>(scenario.size_px().height / 2, scenario.size_px().width / 2) == 255);
  }
}

TEST_CASE("a sphere around the camera covers every pixel without a seam") {
  for (const bool wide : {false, true})
    for (const glm::dvec3 offset : {glm::dvec3(0, 0, 0), glm::dvec3(1, -2, 3)}) {
      if (!wide && offset.x != 0) continue;
      CAPTURE(wide);
      CAPTURE(offset.x);
      Scenario scenario(wide ? cv::Size(640, 480) : cv::Size(320, 240));
      if (wide) see_nearly_all(scenario);
      scenario.project.compositing.supersampling = 1;  // six large faces
      write_sphere_obj(scenario.path("sphere.obj"), 8);
      scenario.add("sphere.obj", glm::dvec3(0, 0, -150) + offset);
      const ComposedFrame frame = composed(scenario);
      const IntruderTruth& truth = frame.truth.intruders.front();
      CHECK(cv::countNonZero(frame.mask == 255) == scenario.size_px().area());
      CHECK(truth.in_image);
      CHECK(truth.visible_box == cv::Rect({0, 0}, scenario.size_px()));
      CHECK(is_finite(truth));
    }
}

TEST_CASE("an intruder 100 km away is a faint spot in the right place") {
  Scenario scenario;
  write_obj(scenario.path("plate.obj"), {{{-0.01, -30, -30}, {0.01, 30, 30}}}, 1);
  scenario.add("plate.obj", {1e5, 1e4, -150 - 2e3});
  const ComposedFrame frame = composed(scenario);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(truth.position_m == glm::dvec3(1e5, 1e4, -2e3));
  REQUIRE(truth.amodal_box);
  CHECK(truth.amodal_box->width == doctest::Approx(0.18).epsilon(1e-3));  // 60 m * 300 px / 100 km
  CHECK(truth.amodal_box->x + 0.09 == doctest::Approx(159.5 + 30).epsilon(1e-5));
  CHECK(truth.amodal_box->y + 0.09 == doctest::Approx(119.5 - 6).epsilon(1e-5));
  CHECK(truth.in_image);
  CHECK(truth.visible_fraction == doctest::Approx(1.0).epsilon(0.01));
  // 0.0324 px of white: spread over four pixels, each rounded to a code of the mask.
  CHECK(std::abs(cv::sum(frame.mask)[0] - 255 * 0.0324) < 2);
  const cv::Rect box = box_of(frame.mask);
  CHECK(box.contains({189, 113}));
  CHECK(box.area() <= 9);
}

TEST_CASE("an intruder too small for one code value is still in the image by the annotation") {
  Scenario scenario;
  write_obj(scenario.path("dot.obj"), {{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}}, 1);
  scenario.add("dot.obj", {1e5, 0, -150});
  const IntruderTruth truth = composed(scenario).truth.intruders.front();
  CHECK(truth.in_image);
  CHECK(!truth.visible_box);  // 1e-5 px leave no visible pixel
  CHECK(is_finite(truth));
}

TEST_CASE("wide blur over the whole image neither fails nor adds light") {
  Scenario scenario;
  add_aircraft(scenario, {1e5, 0, -150});
  scenario.project.compositing.blur_px_per_m = kPaperBlur_px_per_m;  // 200 px
  const Frame background = even_frame(scenario.size_px(), 100);
  const ComposedFrame frame = test::composed(scenario.opened(), 1, background);
  CHECK(is_finite(frame.truth.intruders.front()));
  CHECK(cv::norm(frame.image.planes[0], background.planes[0], cv::NORM_INF) <= 1);
}

TEST_CASE("ten thousand kilometres from the origin the image is the same bit for bit") {
  const glm::dvec3 far_m(1e7, -1e7, 1e7);
  std::vector<ComposedFrame> frames;
  const Frame background = grainy_frame({320, 240}, 0);
  for (const glm::dvec3& origin_m : {glm::dvec3(0), far_m}) {
    Scenario scenario;
    write_obj(scenario.path("aircraft.obj"), aircraft(), 2);
    IntruderSettings& intruder = scenario.add("aircraft.obj", {});
    // Eighths of a metre, which doubles hold exactly at 1e7 too.
    intruder.trajectory.waypoints = {{.frame = 0, .position_m = origin_m + glm::dvec3(60, -3.125, -151.5)},
                                     {.frame = 2, .position_m = origin_m + glm::dvec3(62, 4.875, -152)}};
    scenario.project.camera.position_m = origin_m + glm::dvec3(0, 0, -150);
    scenario.project.light.position_m = origin_m + glm::dvec3(-2000, 1000, -3000);
    frames.push_back(test::composed(scenario.opened(), 0, background));
  }
  CHECK(!same_planes(frames[0].image, background));
  CHECK(same_planes(frames[0].image, frames[1].image));
  CHECK(same_bytes(frames[0].mask, frames[1].mask));
  CHECK(frames[0].truth.intruders[0].amodal_box == frames[1].truth.intruders[0].amodal_box);
  CHECK(frames[0].truth.intruders[0].position_m == frames[1].truth.intruders[0].position_m);
}

TEST_CASE("an intruder that passes abeam of a pinhole costs no more than any other") {
  // A corner a ten thousandth or a millionth of a millimetre before the plane of the lens has its image up to 1e11 px
  // away.
  for (const double ahead_m : {1e-4, 1e-6, 1e-8}) {
    CAPTURE(ahead_m);
    Scenario scenario;
    write_obj(scenario.path("plank.obj"), {{{0, -1, -1}, {9, 1, 1}}}, 1);
    scenario.add("plank.obj", {ahead_m, 30, -150 + 5});
    const IntruderTruth truth = composed(scenario).truth.intruders.front();
    CHECK(is_finite(truth));
    CHECK(!truth.in_image);
  }
}

TEST_CASE("an intruder across the plane of a pinhole is drawn where it is ahead") {
  // A mast of 60 m below the camera, lying along its axis: it begins behind and ends in the image.
  for (const double shift_m : {0.0, 1e-6, 0.123}) {
    CAPTURE(shift_m);
    Scenario scenario;
    write_obj(scenario.path("mast.obj"), {{{-30, -0.5, -0.5}, {30, 0.5, 0.5}}}, 8);
    scenario.add("mast.obj", {shift_m, 0, -147});
    const ComposedFrame frame = composed(scenario);
    const IntruderTruth& truth = frame.truth.intruders.front();
    CHECK(is_finite(truth));
    CHECK(truth.in_image);
    REQUIRE(truth.visible_box);
    // Its far end: 2.5 m below the axis and 30 m ahead is 25 px below the middle; from there it extends down to the
    // edge.
    CHECK(std::abs(truth.visible_box->y - (119.5 + 0.5 + 25)) <= 1.5);
    CHECK(truth.visible_box->br().y == 240);
  }
}

}  // namespace sigs::test
