// SPDX-License-Identifier: MIT
#include "comparison/lit_like.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "base/pose.h"
#include "comparison/inserted_target.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// A plain sky, a pinhole of 60 degrees across, and a project with one of the sample models.
struct PlainSky {
  TemporaryFolder folder;
  Project project;
  FootageShape shape{.size_px = {640, 480}, .times_s = {0, 0.04}};
  Stretch stretch;
  Box box{200, 180, 70, 26};  // where the real target is to be

  explicit PlainSky(const std::string& model) {
    write_file(folder / "pinhole.yml",
               "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   "
               "cols: 3\n   dt: d\n   data: [ 554., 0., 319.5, 0., 554., 239.5, 0., 0., 1. "
               "]\ndistortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n   data: [ 0., 0., 0., "
               "0., 0. ]\n");
    project.file = "test.json";
    project.footage.video = (folder / "pinhole.yml").string();  // posed_scene takes size and times from the shape
    project.footage.calibration = project.footage.video;
    project.intruders.resize(1);
    project.intruders.front().model.file = (source_dir() / "assets/models" / model / (model + ".obj")).string();
    project.compositing.blur_px_per_m = 0;
    project.light.kind = LightKind::sun;
    project.light.color = {0.8, 0.8, 0.8};
    project.light.sky_color = {0.17, 0.2, 0.26};
    project.light.ground_color = {0.12, 0.12, 0.1};
    Frame frame = blank_frame(PixelLayout::yuv420, shape.size_px, {});
    frame.planes[0].setTo(135);
    frame.planes[1].setTo(140);
    frame.planes[2].setTo(118);
    stretch = {.middle = 0, .frames = {frame}, .boxes = {box}};
  }

  // The frame with the aircraft in it under a sun, and a loose box of it. Error as of Insertion::make().
  Result<Insertion::Composed> under(double azimuth_deg, double elevation_deg, double exposure, std::uint32_t seed) {
    Project truth = project;
    truth.light.sun = {azimuth_deg, elevation_deg};
    truth.light.exposure = exposure;
    MeasuredTarget wanted;
    wanted.look.box = cv::Rect(200, 180, 70, 26);
    wanted.look.area_px = 500;
    SceneFiles files;
    ComposeContext context;
    Result<Insertion> insertion =
        Insertion::make(truth, stretch, shape, wanted, {235, 193}, {.seed = seed}, files, context);
    if (!insertion) return fail(insertion.error());
    return insertion->composed(truth, CameraShake::none);
  }
};

}  // namespace

TEST_CASE("a known exposure is found by an aircraft under it, in views that were not drawn") {
  PlainSky sky("airliner");
  double sum_log = 0, default_log = 0;
  int covered = 0, cases = 0;
  for (const double azimuth_deg : {-150.0, -60.0, 30.0, 120.0})
    for (const double exposure : {0.6, 1.5}) {
      const double elevation_deg = azimuth_deg > 0 ? 40 : 15;
      const auto real = sky.under(azimuth_deg, elevation_deg, exposure, 1000 + static_cast<std::uint32_t>(cases));
      if (!real && real.error().kind == ErrorKind::unavailable) return say_skipped(real.error().text());
      REQUIRE_MESSAGE(real, real.error().text());
      REQUIRE(real->frames.size() == 1);
      Project asked = sky.project;
      asked.light.sun = {azimuth_deg, elevation_deg};
      asked.light.exposure = 1;
      const auto lit = lit_like(asked, sky.shape, real->frames[0], 0, real->boxes[0]);
      REQUIRE_MESSAGE(lit, lit.error().text());
      ++cases;
      sum_log += std::abs(std::log(lit->exposure.value / exposure));
      default_log += std::abs(std::log(1 / exposure));
      covered += std::abs(lit->exposure.value - exposure) < 2 * lit->exposure.sd ? 1 : 0;
      Project lit_project = asked;
      apply(*lit, lit_project);
      CHECK(lit_project.light.exposure == doctest::Approx(lit->exposure.value).epsilon(0.001));
      CHECK(lit_project.light.sun == asked.light.sun);
    }
  // Without looking, an exposure of 1 is off by 1.67 and 1.5 times. Whose paint and view are not known cannot be found
  // exactly: half of that is asked for, and the deviation has to cover nearly all.
  CHECK(sum_log < 0.6 * default_log);
  CHECK(covered >= cases - 1);
}

TEST_CASE("a project with a point light gets the sun under which the exposure was found") {
  PlainSky sky("airliner");
  const auto real = sky.under(165, 25, 0.6, 77);
  if (!real && real.error().kind == ErrorKind::unavailable) return say_skipped(real.error().text());
  REQUIRE(real);
  Project asked = sky.project;
  asked.light.kind = LightKind::point;
  asked.light.sun = {};
  const auto lit = lit_like(asked, sky.shape, real->frames[0], 0, real->boxes[0]);
  REQUIRE_MESSAGE(lit, lit.error().text());
  apply(*lit, asked);
  CHECK(asked.light.kind == LightKind::sun);
  CHECK(asked.light.sun == lit->sun);
  CHECK(asked.light.sun.azimuth_deg.has_value());
  CHECK(asked.light.exposure < 0.9);  // from 1 to about 0.6
}

TEST_CASE("what cannot be lit like is an error that says why") {
  PlainSky sky("airliner");
  const auto& frame = sky.stretch.frames.front();
  const auto empty = lit_like(sky.project, sky.shape, frame, 0, sky.box);
  REQUIRE_FALSE(empty);
  CHECK(empty.error().kind == ErrorKind::bad_data);
  CHECK(empty.error().what.find("draw it around") != std::string::npos);
  for (const Box& box : {Box{-50, -50, 20, 20}, Box{600, 100, 0, 10}, Box{NAN, 10, 10, 10}})
    CHECK_FALSE(lit_like(sky.project, sky.shape, frame, 0, box));

  const auto real = sky.under(100, 30, 1, 7);
  if (!real && real.error().kind == ErrorKind::unavailable) return say_skipped(real.error().text());
  REQUIRE(real);
  Project bare = sky.project;
  bare.intruders.clear();
  const auto without = lit_like(bare, sky.shape, real->frames[0], 0, real->boxes[0]);
  REQUIRE_FALSE(without);
  CHECK(without.error().kind == ErrorKind::usage);
  const std::atomic<bool> cancel{true};
  const auto stopped = lit_like(sky.project, sky.shape, real->frames[0], 0, real->boxes[0], {.cancel = &cancel});
  REQUIRE_FALSE(stopped);
  CHECK(stopped.error().kind == ErrorKind::interrupted);
}
