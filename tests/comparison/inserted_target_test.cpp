// SPDX-License-Identifier: MIT
#include "comparison/inserted_target.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Seven frames of a dark rectangle of 30x14 that moves over a bright sky, and boxes around it.
Stretch moving_rectangle(cv::Point2d step_px) {
  Stretch stretch{.middle = 10};
  for (int n = -3; n <= 3; ++n) {
    Frame frame = blank_frame(PixelLayout::yuv420, {640, 480}, {});
    frame.planes[0].setTo(200);
    frame.planes[1].setTo(128);
    frame.planes[2].setTo(128);
    const cv::Point at(100 + cvRound(n * step_px.x), 100 + cvRound(n * step_px.y));
    frame.planes[0](cv::Rect(at, cv::Size(30, 14))).setTo(60);
    stretch.frames.push_back(frame);
    stretch.boxes.push_back({at.x - 5.0, at.y - 5.0, 40, 24});
  }
  return stretch;
}

struct Setting {
  TemporaryFolder folder;
  Project project;
  FootageShape shape{.size_px = {640, 480}};
  SceneFiles files;
  ComposeContext context;

  Setting() {
    const auto calibration = folder / "pinhole.yml";
    write_file(calibration,
               "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   "
               "cols: 3\n   dt: d\n   data: [ 550., 0., 319.5, 0., 550., 239.5, 0., 0., 1. "
               "]\ndistortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n   data: [ 0., 0., 0., "
               "0., 0. ]\n");
    project.file = "test.json";
    project.footage.video = calibration.string();  // posed_scene takes size and times from the shape
    project.footage.calibration = calibration.string();
    project.intruders.resize(1);
    project.intruders.front().model.file = (source_dir() / "assets/models/airliner/airliner.obj").string();
    project.compositing.blur_px_per_m = 0;
    for (int n = 0; n < 30; ++n) shape.times_s.push_back(n / 25.0);
    shape.frame_interval_s = 0.04;
  }
};

}  // namespace

TEST_CASE("the intruder beside is as wide as the real target, of about its aspect, and flies as it does") {
  Setting setting;
  const Stretch stretch = moving_rectangle({2, -1});
  const auto real = measured_target(stretch.frames, stretch.boxes);
  REQUIRE(real);
  CHECK(real->look.box == cv::Rect(100, 100, 30, 14));
  REQUIRE(real->path_px.size() == 7);
  CHECK(real->path_px.back().x == doctest::Approx(6).epsilon(0.01));
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    auto insertion = Insertion::make(setting.project, stretch, setting.shape, *real, {400, 300}, {.seed = seed},
                                     setting.files, setting.context);
    if (!insertion && insertion.error().kind == ErrorKind::unavailable) return say_skipped(insertion.error().text());
    REQUIRE_MESSAGE(insertion, insertion.error().text());
    const auto composed = insertion->composed(setting.project, CameraShake::none);
    REQUIRE(composed);
    REQUIRE(composed->frames.size() == 7);
    const auto target = measured_target(composed->frames, composed->boxes);
    REQUIRE(target);
    CHECK(std::abs(target->look.box.width - 30) <= 2);  // a silhouette by threshold has whole pixels
    const double aspect = static_cast<double>(target->look.box.width) / target->look.box.height;
    CHECK(std::abs(std::log(aspect / (30 / 14.0))) < 0.3);
    CHECK(std::abs(target->look.box.x + 15 - 400) <= 3);
    CHECK(std::abs(target->look.box.y + target->look.box.height / 2 - 300) <= 3);
    // The boxes of the truth go along with the real target.
    CHECK(composed->boxes[6].x - composed->boxes[0].x == doctest::Approx(12).epsilon(0.05));
    CHECK(composed->boxes[6].y - composed->boxes[0].y == doctest::Approx(-6).epsilon(0.08));
    // Only what is near the intruder has changed.
    cv::Mat changed = composed->frames[3].planes[0] != stretch.frames[3].planes[0];
    changed(cv::Rect(350, 250, 100, 100)).setTo(0);
    CHECK(cv::countNonZero(changed) == 0);
  }
}

TEST_CASE("with the camera's shake the intruder goes where the real target goes, frame by frame") {
  Setting setting;
  const Stretch stretch = moving_rectangle({0, 0});
  auto real = measured_target(stretch.frames, stretch.boxes);
  REQUIRE(real);
  real->path_px = {{0, 0}, {3, 0}, {0, 2}, {0, 0}, {-3, 0}, {0, -2}, {1, 1}};
  auto insertion =
      Insertion::make(setting.project, stretch, setting.shape, *real, {400, 300}, {}, setting.files, setting.context);
  if (!insertion && insertion.error().kind == ErrorKind::unavailable) return say_skipped(insertion.error().text());
  REQUIRE(insertion);
  const auto composed = insertion->composed(setting.project, CameraShake::as_real_target);
  REQUIRE(composed);
  for (std::size_t i = 0; i < 7; ++i) {
    // The aircraft flies on by some metres, which changes its box by a fraction of a pixel.
    const Box &here = composed->boxes[i], &middle = composed->boxes[3];
    CHECK(std::abs(here.x + here.width / 2 - middle.x - middle.width / 2 - real->path_px[i].x) < 0.3);
    CHECK(std::abs(here.y + here.height / 2 - middle.y - middle.height / 2 - real->path_px[i].y) < 0.3);
  }
}

TEST_CASE("of several views the one is taken whose silhouette is as large as the real target's") {
  Setting setting;
  const Stretch stretch = moving_rectangle({0, 0});
  const auto real = measured_target(stretch.frames, stretch.boxes);
  REQUIRE(real);
  double largest = 0;
  std::vector<double> areas_px;
  for (const int tries : {1, 1, 1, 1, 1, 6}) {
    const auto seed = static_cast<std::uint32_t>(tries == 1 ? areas_px.size() : 0);
    auto insertion = Insertion::make(setting.project, stretch, setting.shape, *real, {400, 300},
                                     {.seed = seed, .tries = tries}, setting.files, setting.context);
    if (!insertion && insertion.error().kind == ErrorKind::unavailable) return say_skipped(insertion.error().text());
    REQUIRE_MESSAGE(insertion, insertion.error().text());
    const auto target = insertion->middle_target(setting.project, CameraShake::none);
    REQUIRE(target);
    REQUIRE(*target);
    areas_px.push_back((*target)->look.area_px);
    if (tries == 1) largest = std::max(largest, areas_px.back());
  }
  // A rectangle is fuller than any aircraft, so the largest of the views 0 to 4, or view 5, is the most similar one.
  CHECK(areas_px.back() > 0.97 * largest);  // the sizes in whole pixels shift areas a little
}

TEST_CASE("into gray footage a gray intruder is put, whatever colours its paint and the light have") {
  Setting setting;
  const Stretch stretch = moving_rectangle({0, 0});
  const auto real = measured_target(stretch.frames, stretch.boxes);
  REQUIRE(real);
  setting.project.intruders.front().model.file =
      (source_dir() / "assets/models/light-aircraft/light-aircraft.obj").string();
  setting.project.light.kind = LightKind::sun;
  setting.project.light.sun = {.azimuth_deg = 165, .elevation_deg = 25};
  setting.project.light.sky_color = {0.2, 0.4, 0.9};
  setting.project.appearance.chroma_blur_px = 1.2;
  setting.project.appearance.haze.visibility_m = 5000;
  for (const double saturation : {1.0, 0.0}) {
    setting.project.appearance.saturation = saturation;  // 0 is what is found in gray footage
    auto insertion =
        Insertion::make(setting.project, stretch, setting.shape, *real, {400, 300}, {}, setting.files, setting.context);
    if (!insertion && insertion.error().kind == ErrorKind::unavailable) return say_skipped(insertion.error().text());
    REQUIRE_MESSAGE(insertion, insertion.error().text());
    const auto composed = insertion->composed(setting.project, CameraShake::none);
    REQUIRE(composed);
    REQUIRE(composed->frames.size() == 7);
    CHECK(cv::countNonZero(composed->frames[3].planes[0] != stretch.frames[3].planes[0]) > 100);
    const int colored =
        cv::countNonZero(composed->frames[3].planes[1] != 128) + cv::countNonZero(composed->frames[3].planes[2] != 128);
    CHECK((colored > 0) == (saturation > 0));
  }
}

TEST_CASE("a project without an intruder cannot be put beside") {
  Setting setting;
  setting.project.intruders.clear();
  const Stretch stretch = moving_rectangle({0, 0});
  const auto real = measured_target(stretch.frames, stretch.boxes);
  REQUIRE(real);
  const auto insertion =
      Insertion::make(setting.project, stretch, setting.shape, *real, {400, 300}, {}, setting.files, setting.context);
  REQUIRE_FALSE(insertion);
  CHECK(insertion.error().kind == ErrorKind::usage);
}
