// SPDX-License-Identifier: MIT
#include "camera/pinhole_view.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/pose.h"

namespace sigs::test {
namespace {

// Turned to the right by yaw_rad: what lies there in the camera frame is ahead in the view.
VirtualCamera turned_right(double yaw_rad) {
  return {.view_from_camera = {glm::conjugate(rotation_of({.yaw_rad = yaw_rad})), {0, 0, 0}},
          .focal_px = 100,
          .center_px = {20, 10},
          .size_px = cv::Size(41, 21)};
}

}  // namespace

TEST_CASE("a virtual view sees what it is turned to at its center") {
  const VirtualCamera view = turned_right(0.5);
  const auto pixel = view.pixel(7.0 * glm::dvec3{std::cos(0.5), std::sin(0.5), 0});
  REQUIRE(pixel.has_value());
  CHECK(glm::distance(*pixel, {20, 10}) < 1e-12);  // rounding
}

TEST_CASE("a virtual view is a pinhole") {
  const VirtualCamera view = turned_right(0);
  CHECK(view.pixel({10, 1, -2}) == glm::dvec2{30, -10});
  CHECK(view.pixel({1e7, 1e6, -2e6}) == glm::dvec2{30, -10});
}

TEST_CASE("a virtual view sees nothing behind itself") {
  const VirtualCamera view = turned_right(3);
  CHECK_FALSE(view.pixel({1, 0, 0}).has_value());
  CHECK(view.pixel({-1, 0, 0}).has_value());
  CHECK_FALSE(view.pixel({0, 0, 0}).has_value());
  CHECK_FALSE(view.pixel({std::numeric_limits<double>::quiet_NaN(), 0, 0}).has_value());
  CHECK_FALSE(view.pixel({-1, std::numeric_limits<double>::infinity(), 0}).has_value());
}

}  // namespace sigs::test
