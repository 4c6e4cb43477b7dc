// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "autocalibration/lens_by_motion.h"
#include "autocalibration/made_tracks.h"

namespace sigs::test {
namespace {

const cv::Size kSize_px(1280, 720);

struct KnownLens {
  const char* name;
  Camera camera;
};
std::vector<KnownLens> known_lenses() {
  return {{"pinhole", made_camera(kSize_px, LensModel::brown_conrady, 1000, 0)},
          {"narrow", made_camera(kSize_px, LensModel::brown_conrady, 2400, 0)},
          {"barrel", made_camera(kSize_px, LensModel::brown_conrady, 1000, -0.15)},
          {"fisheye", made_camera(kSize_px, LensModel::kannala_brandt, 700, 0.02)}};
}

bool contains(const LensEstimate& fit, double truth_rad) {
  return fit.field_low_rad <= truth_rad && truth_rad <= fit.field_high_rad;
}

}  // namespace

TEST_CASE("a camera that pans shows its field of view, within the limits stated") {
  for (const KnownLens& lens : known_lenses())
    for (const unsigned seed : {11U}) {
      CAPTURE(lens.name);
      CAPTURE(seed);
      const LensAnswer found = lens_by_turn(made_tracks(lens.camera, {.seed = seed}).tracks, {});
      REQUIRE_MESSAGE(found.fit, found.reason);
      CHECK(contains(*found.fit, field_rad(lens.camera)));
      // Half of the limits' distance is 2 % or more, by what the model leaves out.
      CHECK(found.fit->lens.horizontal_field_rad() == doctest::Approx(field_rad(lens.camera)).epsilon(0.03));
    }
}

TEST_CASE("a gyroscope shows the field of view, and its own offset in time") {
  for (const KnownLens& lens : known_lenses())
    for (const double pan_rad : {0.5, 0.01}) {
      CAPTURE(lens.name);
      CAPTURE(pan_rad);
      const MadeTracks made = made_tracks(lens.camera, {.seed = 11, .pan_rad = pan_rad, .gyro_offset_s = -0.21});
      const GyroAnswer found = lens_by_gyro(made.tracks, made.log, {});
      REQUIRE_MESSAGE(found.answer.fit, found.answer.reason);
      CHECK(contains(*found.answer.fit, field_rad(lens.camera)));
      CHECK(found.offset_s == doctest::Approx(-0.21).epsilon(0.01));
    }
}

TEST_CASE("a gyroscope shows the field of view of a camera that travels, too") {
  const Camera camera = made_camera(kSize_px, LensModel::brown_conrady, 1000, 0);
  const MadeTracks made = made_tracks(camera, {.seed = 12, .pan_rad = 0.17, .speed_mps = 15});
  const GyroAnswer found = lens_by_gyro(made.tracks, made.log, {});
  REQUIRE_MESSAGE(found.answer.fit, found.answer.reason);
  CHECK(contains(*found.answer.fit, field_rad(camera)));
  const LensAnswer turn = lens_by_turn(made.tracks, {});
  CHECK_FALSE(turn.fit);
  CHECK_FALSE(turn.reason.empty());
}

TEST_CASE("no field of view comes from a camera at rest, another flight's gyroscope, or no features") {
  const Camera camera = made_camera(kSize_px, LensModel::brown_conrady, 1000, 0);
  const MadeTracks still = made_tracks(camera, {.seed = 1, .pan_rad = 0, .shake_rad = 0});
  CHECK_FALSE(lens_by_turn(still.tracks, {}).fit);
  CHECK_FALSE(lens_by_gyro(still.tracks, still.log, {}).answer.fit);
  const MadeTracks moving = made_tracks(camera, {.seed = 2});
  const GyroAnswer foreign = lens_by_gyro(moving.tracks, made_tracks(camera, {.seed = 3}).log, {});
  CHECK_FALSE(foreign.answer.fit);
  CHECK(foreign.answer.reason.find("do not follow") != std::string::npos);
  CHECK_FALSE(lens_by_gyro(moving.tracks, Track{}, {}).answer.fit);
  PixelTracks empty{.size_px = kSize_px};
  CHECK_FALSE(lens_by_turn(empty, {}).fit);
  CHECK_FALSE(lens_by_gyro(empty, moving.log, {}).answer.fit);
  empty.frames.resize(100);
  CHECK_FALSE(lens_by_turn(empty, {}).fit);
  CHECK_FALSE(lens_by_gyro(empty, moving.log, {}).answer.fit);
}

TEST_CASE("a narrow shake gives no field of view without a gyroscope") {
  const Camera camera = made_camera(kSize_px, LensModel::brown_conrady, 1000, 0);
  CHECK_FALSE(lens_by_turn(made_tracks(camera, {.seed = 1, .pan_rad = 0.01}).tracks, {}).fit);
}

TEST_CASE("features that are no numbers, and rates that are none, do not count") {
  const Camera camera = made_camera(kSize_px, LensModel::brown_conrady, 1000, 0);
  MadeTracks made = made_tracks(camera, {.seed = 1});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (TrackedFrame& frame : made.tracks.frames)
    for (std::size_t i = 0; i < frame.features.size(); i += 9) frame.features[i].pixel_px = {nan, nan};
  for (std::size_t i = 0; i < made.log.camera_rate_radps.values.size(); i += 50)
    made.log.camera_rate_radps.values[i].x = std::numeric_limits<double>::infinity();
  const LensAnswer turn = lens_by_turn(made.tracks, {});
  REQUIRE_MESSAGE(turn.fit, turn.reason);
  CHECK(contains(*turn.fit, field_rad(camera)));
  const GyroAnswer gyro = lens_by_gyro(made.tracks, made.log, {});
  REQUIRE_MESSAGE(gyro.answer.fit, gyro.answer.reason);
  CHECK(contains(*gyro.answer.fit, field_rad(camera)));
}

TEST_CASE("the stated limits contain the truth in nineteen of twenty cases or more") {
  const Camera camera = made_camera({640, 480}, LensModel::brown_conrady, 520, -0.1);
  int inside = 0;
  int found = 0;
  for (unsigned seed = 11; seed < 27; ++seed) {
    const LensAnswer turn =
        lens_by_turn(made_tracks(camera, {.seed = seed, .frames = 120, .pan_rad = 0.17}).tracks, {});
    if (!turn.fit) continue;
    ++found;
    inside += contains(*turn.fit, field_rad(camera)) ? 1 : 0;
  }
  CHECK(found >= 12);
  CHECK(inside >= 0.95 * found - 1);
}

}  // namespace sigs::test
