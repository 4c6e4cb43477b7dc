// SPDX-License-Identifier: MIT
#include "appearance/haze.h"

#include <doctest/doctest.h>

#include "made_scene.h"
#include "support/test_data.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;

namespace {

HazeEstimate haze_of(HazyPlain plain, const Camera& camera, const View& view, const Attitude& attitude, int frames,
                     ColorRange range = ColorRange::limited) {
  Haze haze;
  LightImageReader reader;
  for (int i = 0; i < frames; ++i) {
    plain.x_m = 400.0 * i;
    haze.add(reader.read(frame_of(seen(camera, rotation_of(attitude), plain), PixelLayout::yuv420, range), view));
  }
  return haze.finish();
}

void check_airlight(const HazeEstimate& haze, const glm::dvec3& truth, double codes) {
  for (int k = 0; k < 3; ++k) {
    const Estimate& part = haze.airlight[static_cast<std::size_t>(k)];
    CHECK(part.is_known);
    CHECK(std::abs(code_of(part.value) - code_of(truth[k])) < codes);
    CHECK(part.sd > 0);
  }
}

HazeEstimate haze_of_image(const cv::Mat& bgr, PixelLayout layout = PixelLayout::yuv420) {
  const Camera camera = wide_camera(bgr.size());
  Haze haze;
  haze.add(LightImageReader().read(frame_of(bgr, layout),
                                   {.camera = &camera, .world_from_camera = glm::dquat(1, 0, 0, 0), .height_m = 100}));
  return haze.finish();
}

void check_finite(const HazeEstimate& haze) {
  CHECK(std::isfinite(haze.visibility_m.value));
  CHECK(std::isfinite(haze.visibility_m.sd));
  for (const Estimate& part : haze.airlight) CHECK((std::isfinite(part.value) && std::isfinite(part.sd)));
}

}  // namespace

TEST_CASE("visibility and airlight of a made plain are found within 25 % and 5 codes") {
  const Camera camera = wide_camera();
  const Attitude attitude{.roll_rad = 0.05, .pitch_rad = -0.1};
  for (const double visibility_m : {2500.0, 8000.0, 25000.0})
    for (const ColorRange range : {ColorRange::limited, ColorRange::full}) {
      const HazyPlain plain{.visibility_m = visibility_m};
      const View view{.camera = &camera, .world_from_camera = rotation_of(attitude), .height_m = plain.height_m};
      const HazeEstimate haze = haze_of(plain, camera, view, attitude, 4, range);
      REQUIRE(haze.visibility_m.is_known);
      CHECK(haze.visibility_m.value == doctest::Approx(visibility_m).epsilon(0.25));
      CHECK(std::abs(haze.visibility_m.value - visibility_m) < 2.5 * haze.visibility_m.sd);
      check_airlight(haze, plain.airlight, 5);
    }
}

TEST_CASE("with a horizon found in the image the haze is found too") {
  const Camera camera = wide_camera();
  const HazyPlain plain{.visibility_m = 12000};
  const HazeEstimate haze =
      haze_of(plain, camera, {.camera = &camera, .height_m = plain.height_m}, {.roll_rad = -0.1}, 3);
  REQUIRE(haze.visibility_m.is_known);
  CHECK(haze.visibility_m.value ==
        doctest::Approx(12000).epsilon(0.3));  // the horizon itself is a fifth of a degree off
  check_airlight(haze, plain.airlight, 5);
}

TEST_CASE("one frame is enough for a haze that is strong") {
  const Camera camera = wide_camera();
  const HazyPlain plain{.visibility_m = 5000};
  const View view{.camera = &camera, .world_from_camera = glm::dquat(1, 0, 0, 0), .height_m = plain.height_m};
  const HazeEstimate haze = haze_of(plain, camera, view, {}, 1);
  REQUIRE(haze.visibility_m.is_known);
  CHECK(haze.visibility_m.value == doctest::Approx(5000).epsilon(0.25));
}

TEST_CASE("without height or calibration the airlight alone is known, and it is said what is missing") {
  const Camera camera = wide_camera();
  const HazyPlain plain;
  const HazeEstimate no_height =
      haze_of(plain, camera, {.camera = &camera, .world_from_camera = glm::dquat(1, 0, 0, 0)}, {}, 1);
  CHECK_FALSE(no_height.visibility_m.is_known);
  CHECK(no_height.visibility_m.why.find("height") != std::string::npos);
  check_airlight(no_height, plain.airlight, 5);
  const HazeEstimate no_camera = haze_of(plain, camera, {}, {}, 1);
  CHECK_FALSE(no_camera.visibility_m.is_known);
  CHECK(no_camera.visibility_m.why.find("calibration") != std::string::npos);
  check_airlight(no_camera, plain.airlight, 8);  // the lowest degrees of the sky are taken by guess
}

TEST_CASE("ground in clear air gives no visibility") {
  const Camera camera = wide_camera();
  const HazyPlain plain{.visibility_m = 1e9, .land = {0.3, 0.33, 0.2}};
  const View view{.camera = &camera, .world_from_camera = glm::dquat(1, 0, 0, 0), .height_m = plain.height_m};
  const HazeEstimate haze = haze_of(plain, camera, view, {}, 3);
  CHECK_FALSE(haze.visibility_m.is_known);
  CHECK_FALSE(haze.visibility_m.why.empty());
}

TEST_CASE("blank, black, over-exposed and gray images give no visibility and no number that is not finite") {
  for (const int level : {0, 90, 255})
    for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::gray}) {
      const HazeEstimate haze = haze_of_image(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(level)), layout);
      CHECK_FALSE(haze.visibility_m.is_known);
      CHECK_FALSE(haze.visibility_m.why.empty());
      check_finite(haze);
    }
  const HazeEstimate none = Haze().finish();
  CHECK_FALSE(none.visibility_m.is_known);
  CHECK(none.airlight[0].value == doctest::Approx(0.6));
  CHECK_FALSE(none.airlight[0].is_known);
  check_finite(none);
}

TEST_CASE("the haze of the sample footage is found through its camera's tone curve") {
  const std::filesystem::path assets = source_dir() / "assets";
  const auto camera = read_calibration(assets / "calibrations" / "sample.xml");
  REQUIRE(camera);
  for (const char* name : {"sample.mp4", "table1_clear.mp4", "table1_clouds.mp4", "table1_vibration.mp4"}) {
    auto footage = FrameSource::open(assets / "footage" / name);
    REQUIRE(footage);
    Haze haze;
    LightImageReader reader;
    const View view{.camera = &*camera, .world_from_camera = glm::dquat(1, 0, 0, 0), .height_m = 150};
    for (int n = 0; n < footage->info().frame_count(); n += 50) haze.add(reader.read(footage->read(n).value(), view));
    const HazeEstimate found = haze.finish();
    CAPTURE(name);
    REQUIRE(found.visibility_m.is_known);
    // assets/footage/light.h: green light falls by exp(-d / 11500).
    CHECK(found.visibility_m.value == doctest::Approx(3 * 11500).epsilon(0.25));
    // The colour of distant haze there, through sensor.cpp by hand: 214, 223, 230; table1_clouds is brighter.
    const bool is_brighter = std::string_view(name) == "table1_clouds.mp4";
    const glm::dvec3 truth = is_brighter ? glm::dvec3(226, 233, 238) : glm::dvec3(214, 223, 230);
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(code_of(found.airlight[static_cast<std::size_t>(k)].value) - truth[k]) < 5.5);  // truth is rounded
  }
}
