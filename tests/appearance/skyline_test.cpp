// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include "appearance/light_image.h"
#include "made_scene.h"

using namespace sigs;
using namespace sigs::test;

namespace {

LightImage image_of(const cv::Mat& bgr, const View& view = {}) {
  return LightImageReader().read(frame_of(bgr), view);
}

cv::Mat noise_image(int low, int high) {
  cv::Mat bgr(480, 640, CV_8UC3);
  cv::RNG random(7);
  random.fill(bgr, cv::RNG::UNIFORM, low, high);
  return bgr;
}

}  // namespace

TEST_CASE("the horizon above a hazy plain is found, just below its place, whatever roll and pitch") {
  const Camera camera = wide_camera();
  for (const Attitude attitude :
       {Attitude{}, Attitude{.roll_rad = 0.2, .pitch_rad = 0.1}, Attitude{.roll_rad = -0.5, .pitch_rad = -0.15}}) {
    const cv::Mat bgr = seen(camera, rotation_of(attitude), HazyPlain{.visibility_m = 60000});
    const LightImage image = image_of(bgr, {.camera = &camera});
    REQUIRE(image.skyline);
    CHECK(image.skyline->from_image);
    const glm::dvec3 up = glm::conjugate(rotation_of(attitude)) * glm::dvec3(0, 0, -1);
    // The land emerges from the haze some tenths of a degree below the horizon, where the fall of brightness is
    // steepest.
    CHECK(deg_of_rad(angle_between(up, image.skyline->up)) < 1.5);
  }
}

TEST_CASE("a sharp horizon is found within a third of a degree") {
  const Camera camera = wide_camera();
  for (const Attitude attitude : {Attitude{.pitch_rad = 0.03}, Attitude{.roll_rad = 0.35, .pitch_rad = -0.2}}) {
    const auto light = [](const glm::dvec3& ray) { return ray.z < 0 ? glm::dvec3(0.5) : glm::dvec3(0.2); };
    const LightImage image = image_of(seen(camera, rotation_of(attitude), light), {.camera = &camera});
    REQUIRE(image.skyline);
    const glm::dvec3 up = glm::conjugate(rotation_of(attitude)) * glm::dvec3(0, 0, -1);
    CHECK(deg_of_rad(angle_between(up, image.skyline->up)) < 0.33);  // a cell of the grid is 0.25 degrees
  }
}

TEST_CASE("a horizon divides the image without a calibration too") {
  const LightImage image = image_of(seen(wide_camera(), rotation_of({.roll_rad = 0.3}), HazyPlain{}));
  REQUIRE(image.skyline);
  CHECK_FALSE(image.rays.angles_are_known());
  CHECK(*image.elevation_rad(160, 40) > 0);
  CHECK(*image.elevation_rad(160, 200) < 0);
  CHECK(*image.elevation_rad(300, 110) < 0);  // the horizon's right end rises with the right side down
  CHECK(*image.elevation_rad(20, 130) > 0);
}

TEST_CASE("an attitude that is known goes before what the image shows") {
  const Camera camera = wide_camera();
  const glm::dquat attitude = rotation_of({.roll_rad = 0.1, .pitch_rad = -0.2});
  const LightImage image =
      image_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 90, 90)), {.camera = &camera, .world_from_camera = attitude});
  REQUIRE(image.skyline);
  CHECK_FALSE(image.skyline->from_image);
  CHECK(angle_between(image.skyline->up, glm::conjugate(attitude) * glm::dvec3(0, 0, -1)) < 1e-9);
}

TEST_CASE("there is no horizon in a blank image, in noise, in an even slope of brightness and in a tiny image") {
  CHECK_FALSE(image_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar(120, 120, 120))).skyline);
  CHECK_FALSE(image_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar(0, 0, 0))).skyline);
  CHECK_FALSE(image_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar(255, 255, 255))).skyline);
  CHECK_FALSE(image_of(noise_image(60, 200)).skyline);
  cv::Mat slope(480, 640, CV_8UC3);
  for (int y = 0; y < slope.rows; ++y) slope.row(y).setTo(cv::Scalar::all(220 - y / 4));
  CHECK_FALSE(image_of(slope).skyline);
  CHECK_FALSE(image_of(cv::Mat(6, 6, CV_8UC3, cv::Scalar(9, 9, 9))).skyline);
  CHECK(LightImageReader().read(Frame{}).empty());
}

TEST_CASE("an attitude that is not a number is not used") {
  const Camera camera = wide_camera();
  const double nan = std::nan("");
  const View view{.camera = &camera, .world_from_camera = glm::dquat(nan, nan, nan, nan)};
  CHECK_FALSE(image_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar(120, 120, 120)), view).skyline);
}

TEST_CASE("the grid's light is that of the code values, in every layout and range") {
  cv::Mat bgr(96, 128, CV_8UC3, cv::Scalar(180, 120, 60));
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
    for (const ColorRange range : {ColorRange::limited, ColorRange::full}) {
      const LightGrid grid = light_grid_of(frame_of(bgr, layout, range));
      const cv::Vec3f light = grid.light(40, 60);
      const int codes[3] = {60, 120, 180};
      for (int k = 0; k < 3; ++k)  // a code of luma and one of chroma are rounded
        CHECK(code_of(static_cast<double>(light[k])) == doctest::Approx(codes[k]).epsilon(0.02));
      // The same in 10 and 16 bits, whose codes are more.
      for (const int bit_depth : {10, 16}) {
        const ColorInfo color = frame_of(bgr, layout, range).color;
        const LightGrid deep = light_grid_of(frame_of_bgr(bgr, layout, color, bit_depth));
        for (int k = 0; k < 3; ++k)
          CHECK(code_of(static_cast<double>(deep.light(40, 60)[k])) == doctest::Approx(codes[k]).epsilon(0.02));
        CHECK(deep.luma(40, 60) == doctest::Approx(grid.luma(40, 60)).epsilon(0.02));
      }
    }
  const LightGrid gray = light_grid_of(frame_of(bgr, PixelLayout::gray));
  CHECK(gray.light(5, 5)[0] == doctest::Approx(gray.light(5, 5)[2]));
}
