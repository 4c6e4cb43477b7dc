// SPDX-License-Identifier: MIT
#include "camera/row_motion.h"

#include <doctest/doctest.h>

#include <cmath>

#include "camera/example_lenses.h"

namespace sigs::test {
namespace {

constexpr int kRows = 480;

// A camera that yaws to the right by rate_radps sees a body at rest move to the left.
RowMotion yawing(double rate_radps, double readout_s, const glm::dvec3& body_m) {
  return RowMotion(
      [=](double since_s) {
        const glm::dquat camera_from_world = glm::conjugate(rotation_of({0, 0, rate_radps * since_s}));
        return Pose<frame::Camera, frame::Body>{camera_from_world, camera_from_world * body_m};
      },
      kRows, readout_s);
}

Lens pinhole_lens() {
  return lens_of(LensModel::brown_conrady, 500, 500, {319.5, 239.5}, {});
}

}  // namespace

TEST_CASE("the middle row has the frame's own time, the first half a readout before, the last half after") {
  const RowMotion motion = yawing(2, 0.04, {100, 0, 0});
  const auto yaw = [&](double row) { return -attitude_of(motion.at_row(row).rotation).yaw_rad; };
  CHECK(yaw((kRows - 1) / 2.0) == doctest::Approx(0).epsilon(1e-12));
  CHECK(yaw(0) == doctest::Approx(-0.04).epsilon(1e-9));
  CHECK(yaw(kRows - 1) == doctest::Approx(0.04).epsilon(1e-9));
  CHECK(yaw(-1000) == yaw(0));
  CHECK(yaw(1e9) == yaw(kRows - 1));
}

TEST_CASE("a point appears in the row that is read while it is there") {
  const RowMotion motion = yawing(1.5, 0.03, {200, 10, -40});
  const Lens lens = pinhole_lens();
  const std::optional<glm::dvec2> pixel = motion.pixel(lens, {0, 0, 0});
  REQUIRE(pixel);
  // By bisection over the rows instead.
  double low = 0, high = kRows - 1;
  for (int i = 0; i < 60; ++i) {
    const double row = (low + high) / 2;
    const double since_s = 0.03 * (row / (kRows - 1) - 0.5);
    const glm::dvec3 p = glm::conjugate(rotation_of({0, 0, 1.5 * since_s})) * glm::dvec3(200, 10, -40);
    (lens.pixel(p)->y > row ? low : high) = row;
  }
  CHECK(pixel->y == doctest::Approx(low).epsilon(1e-6));
}

TEST_CASE("the ray of a row, turned to the frame's time, meets the same point of the body") {
  const glm::dvec3 body_m{300, -20, 15};
  const RowMotion motion = yawing(0.7, 0.02, body_m);
  const Lens lens = pinhole_lens();
  for (const double row : {0.0, 100.0, 239.5, 479.0}) {
    const glm::dvec3 seen = motion.at_row(row).translation_m;
    CHECK(angle_between(motion.row_transform(row) * seen, body_m) < 1e-12);
    CHECK(angle_between(motion.row_transform(row) * (1e-3 * seen), body_m) < 1e-12);
  }
  CHECK(motion.row_transform(100) * glm::dvec3(0) == glm::dvec3(0));
  CHECK(motion.max_shift_px(lens) == doctest::Approx(500 * 0.007).epsilon(0.02));
}

TEST_CASE("a body behind the camera, at the camera or out of the field has no pixel") {
  const Lens lens = pinhole_lens();
  CHECK_FALSE(yawing(0.5, 0.02, {-100, 0, 0}).pixel(lens, {0, 0, 0}));
  CHECK_FALSE(yawing(0.5, 0.02, {0, 0, 0}).pixel(lens, {0, 0, 0}));
  CHECK(yawing(0.5, 0.02, {-100, 0, 0}).max_shift_px(lens) == 0);
}

}  // namespace sigs::test
