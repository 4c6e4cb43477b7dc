// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/made_scenes.h"

namespace sigs::test {
namespace {

// Every number of a truth that goes into a file.
bool is_finite(const IntruderTruth& truth) {
  bool fine = std::isfinite(truth.visible_fraction) && truth.visible_fraction >= 0 && truth.visible_fraction <= 1;
  for (int i = 0; i < 3; ++i) fine = fine && std::isfinite(truth.position_m[i]);
  if (truth.silhouette)
    fine = fine && std::isfinite(truth.silhouette->x) && std::isfinite(truth.silhouette->y) &&
           truth.silhouette->width >= 0 && truth.silhouette->height >= 0 && std::isfinite(truth.silhouette->width) &&
           std::isfinite(truth.silhouette->height);
  return fine;
}

void add_aircraft(Lot& lot, const glm::dvec3& position_m) {
  write_obj(lot.path("aircraft.obj"), aircraft(), 2);
  lot.add("aircraft.obj", position_m);
}

ComposedFrame composed(const Lot& lot) {
  return test::composed(lot.opened(), 1, grainy_frame(lot.size_px(), 1));
}

// A made 200 degree fisheye.
void see_nearly_all(Lot& lot) {
  write_calibration(lot.path("wide.xml"), {180, 0, 319.5, 0, 180, 239.5, 0, 0, 1}, {0, 0, 0, 0}, {640, 480}, true);
  lot.project.footage.calibration = "wide.xml";
}

}  // namespace

TEST_CASE("an intruder behind the camera is nowhere in the picture") {
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain}) {
    Lot lot;
    lot.project.compositing.method = method;
    add_aircraft(lot, {-80, 5, -145});
    const Frame background = grainy_frame(lot.size_px(), 1);
    Bench bench;
    const Scene scene = lot.opened();
    const Result<ComposedFrame> frame = compose_frame(scene, 1, background, bench);
    REQUIRE(frame.has_value());
    const IntruderTruth& truth = frame->truth.intruders.front();
    CHECK(!truth.in_picture);
    CHECK(!truth.silhouette);
    CHECK(!truth.box);
    CHECK(truth.visible_fraction == 0);
    CHECK(truth.position_m == glm::dvec3(-80, 5, 5));
    CHECK(same_planes(frame->picture, background));
    CHECK(frame->mask.empty());
    CHECK(bench.renderer_description() == "");  // no OpenGL was made
  }
}

TEST_CASE("an intruder beside the picture has a silhouette out there and is not in it") {
  Lot lot;
  add_aircraft(lot, {100, 80, -150});
  const ComposedFrame frame = composed(lot);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(!truth.in_picture);
  CHECK(!truth.box);
  REQUIRE(truth.silhouette);
  CHECK(truth.silhouette->x > 320);
  CHECK(frame.mask.empty());
}

TEST_CASE("a face half a metre ahead fills the picture") {
  Lot lot;
  write_obj(lot.path("cube.obj"), {{{-6, -6, -6}, {6, 6, 6}}}, 4);
  lot.add("cube.obj", {6.5, 0, -150});
  const ComposedFrame frame = composed(lot);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(cv::countNonZero(frame.mask == 255) == lot.size_px().area());
  CHECK(truth.box == cv::Rect({0, 0}, lot.size_px()));
  CHECK(truth.in_picture);
  CHECK(is_finite(truth));
  // 12 m at 0.5 m: 7200 px each way, of which the picture holds 320 by 240; measured in 256 steps across.
  CHECK(truth.visible_fraction == doctest::Approx(320.0 * 240 / (7200.0 * 7200)).epsilon(0.03));
  CHECK(truth.silhouette->width == doctest::Approx(7200));
}

TEST_CASE("an aircraft half a metre ahead is drawn") {
  for (const bool wide : {false, true}) {
    CAPTURE(wide);
    Lot lot(wide ? cv::Size(640, 480) : cv::Size(320, 240));
    if (wide) see_nearly_all(lot);
    lot.project.compositing.supersampling = 1;  // six large faces
    add_aircraft(lot, {6.5, 0, -150});  // the tail is 0.5 m ahead
    const ComposedFrame frame = composed(lot);
    CHECK(frame.truth.intruders.front().in_picture);
    CHECK(is_finite(frame.truth.intruders.front()));
    CHECK(frame.mask.at<uchar>(lot.size_px().height / 2, lot.size_px().width / 2) == 255);
  }
}

TEST_CASE("a sphere around the camera covers every pixel without a seam") {
  for (const bool wide : {false, true})
    for (const glm::dvec3 offset : {glm::dvec3(0, 0, 0), glm::dvec3(1, -2, 3)}) {
      if (!wide && offset.x != 0) continue;
      CAPTURE(wide);
      CAPTURE(offset.x);
      Lot lot(wide ? cv::Size(640, 480) : cv::Size(320, 240));
      if (wide) see_nearly_all(lot);
      lot.project.compositing.supersampling = 1;  // six large faces
      write_sphere_obj(lot.path("sphere.obj"), 8);
      lot.add("sphere.obj", glm::dvec3(0, 0, -150) + offset);
      const ComposedFrame frame = composed(lot);
      const IntruderTruth& truth = frame.truth.intruders.front();
      CHECK(cv::countNonZero(frame.mask == 255) == lot.size_px().area());
      CHECK(truth.in_picture);
      CHECK(truth.box == cv::Rect({0, 0}, lot.size_px()));
      CHECK(is_finite(truth));
    }
}

TEST_CASE("an intruder 100 km away is a faint spot in the right place") {
  Lot lot;
  write_obj(lot.path("plate.obj"), {{{-0.01, -30, -30}, {0.01, 30, 30}}}, 1);
  lot.add("plate.obj", {1e5, 1e4, -150 - 2e3});
  const ComposedFrame frame = composed(lot);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(truth.position_m == glm::dvec3(1e5, 1e4, -2e3));
  REQUIRE(truth.silhouette);
  CHECK(truth.silhouette->width == doctest::Approx(0.18).epsilon(1e-3));  // 60 m * 300 px / 100 km
  CHECK(truth.silhouette->x + 0.09 == doctest::Approx(159.5 + 30).epsilon(1e-5));
  CHECK(truth.silhouette->y + 0.09 == doctest::Approx(119.5 - 6).epsilon(1e-5));
  CHECK(truth.in_picture);
  CHECK(truth.visible_fraction == doctest::Approx(1.0).epsilon(0.01));
  // 0.0324 px of white: spread over four pixels, each rounded to a code of the mask.
  CHECK(std::abs(cv::sum(frame.mask)[0] - 255 * 0.0324) < 2);
  const cv::Rect box = box_of(frame.mask);
  CHECK(box.contains({189, 113}));
  CHECK(box.area() <= 9);
}

TEST_CASE("an intruder too small for one code value is still in the picture by its truth") {
  Lot lot;
  write_obj(lot.path("dot.obj"), {{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}}, 1);
  lot.add("dot.obj", {1e5, 0, -150});
  const IntruderTruth truth = composed(lot).truth.intruders.front();
  CHECK(truth.in_picture);
  CHECK(!truth.box);  // 1e-5 px leave no visible pixel
  CHECK(is_finite(truth));
}

TEST_CASE("far blur over the whole picture neither fails nor adds light") {
  Lot lot;
  add_aircraft(lot, {1e5, 0, -150});
  lot.project.compositing.blur_px_per_m = CompositingSettings{}.blur_px_per_m;  // 200 px
  const Frame background = even_frame(lot.size_px(), 100);
  const ComposedFrame frame = test::composed(lot.opened(), 1, background);
  CHECK(is_finite(frame.truth.intruders.front()));
  CHECK(cv::norm(frame.picture.planes[0], background.planes[0], cv::NORM_INF) <= 1);
}

TEST_CASE("ten thousand kilometres from the origin the picture is the same bit for bit") {
  const glm::dvec3 far_m(1e7, -1e7, 1e7);
  std::vector<ComposedFrame> frames;
  const Frame background = grainy_frame({320, 240}, 0);
  for (const glm::dvec3& origin_m : {glm::dvec3(0), far_m}) {
    Lot lot;
    write_obj(lot.path("aircraft.obj"), aircraft(), 2);
    IntruderSettings& intruder = lot.add("aircraft.obj", {});
    // Eighths of a metre, which doubles hold exactly at 1e7 too.
    intruder.trajectory.waypoints = {{.frame = 0, .position_m = origin_m + glm::dvec3(60, -3.125, -151.5)},
                                     {.frame = 2, .position_m = origin_m + glm::dvec3(62, 4.875, -152)}};
    lot.project.camera.position_m = origin_m + glm::dvec3(0, 0, -150);
    lot.project.light.position_m = origin_m + glm::dvec3(-2000, 1000, -3000);
    frames.push_back(test::composed(lot.opened(), 0, background));
  }
  CHECK(!same_planes(frames[0].picture, background));
  CHECK(same_planes(frames[0].picture, frames[1].picture));
  CHECK(same_bytes(frames[0].mask, frames[1].mask));
  CHECK(frames[0].truth.intruders[0].silhouette == frames[1].truth.intruders[0].silhouette);
  CHECK(frames[0].truth.intruders[0].position_m == frames[1].truth.intruders[0].position_m);
}

TEST_CASE("an intruder that passes abeam of a pinhole costs no more than any other") {
  // A corner a ten thousandth or a millionth of a millimetre before the plane of the lens has its image up to 1e11 px
  // away.
  for (const double ahead_m : {1e-4, 1e-6, 1e-8}) {
    CAPTURE(ahead_m);
    Lot lot;
    write_obj(lot.path("plank.obj"), {{{0, -1, -1}, {9, 1, 1}}}, 1);
    lot.add("plank.obj", {ahead_m, 30, -150 + 5});
    const IntruderTruth truth = composed(lot).truth.intruders.front();
    CHECK(is_finite(truth));
    CHECK(!truth.in_picture);
  }
}

TEST_CASE("an intruder across the plane of a pinhole is drawn where it is ahead") {
  // A mast of 60 m below the camera, lying along its axis: it begins behind and ends in the picture.
  for (const double shift_m : {0.0, 1e-6, 0.123}) {
    CAPTURE(shift_m);
    Lot lot;
    write_obj(lot.path("mast.obj"), {{{-30, -0.5, -0.5}, {30, 0.5, 0.5}}}, 8);
    lot.add("mast.obj", {shift_m, 0, -147});
    const ComposedFrame frame = composed(lot);
    const IntruderTruth& truth = frame.truth.intruders.front();
    CHECK(is_finite(truth));
    CHECK(truth.in_picture);
    REQUIRE(truth.box);
    // Its far end: 2.5 m below the axis and 30 m ahead is 25 px below the middle; from there it reaches down to the
    // edge.
    CHECK(std::abs(truth.box->y - (119.5 + 0.5 + 25)) <= 1.5);
    CHECK(truth.box->br().y == 240);
  }
}

}  // namespace sigs::test
