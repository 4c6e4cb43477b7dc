// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "base/pose.h"

using namespace sigs;

namespace {

using WorldFromBody = Pose<frame::World, frame::Body>;
using BodyFromCamera = Pose<frame::Body, frame::Camera>;

template <class A, class B>
concept Composable = requires(A a, B b) {
  a* b;
};

double largest_difference(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z});
}

}  // namespace

TEST_CASE("poses multiply only where their frames meet") {
  static_assert(Composable<WorldFromBody, BodyFromCamera>);
  static_assert(!Composable<BodyFromCamera, WorldFromBody>);
  static_assert(std::is_same_v<decltype(WorldFromBody{} * BodyFromCamera{}), Pose<frame::World, frame::Camera>>);
  CHECK(true);
}

TEST_CASE("a pose followed by its inverse leaves every point in place") {
  const WorldFromBody pose{rotation_of({0.3, -0.8, 2.5}), {1e7, -20, 3}};
  for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 2, 3), glm::dvec3(-400, 5, 1e4)})
    CHECK(largest_difference(inverse(pose) * (pose * p), p) < 1e-8);  // doubles at 1e7 m resolve 2e-9 m
}

TEST_CASE("a product of poses applies one after the other") {
  const WorldFromBody a{rotation_of({0.1, 0.2, 0.3}), {1, 2, 3}};
  const BodyFromCamera b{rotation_of({-1, 0.4, 2}), {-5, 0, 9}};
  const glm::dvec3 p(7, -8, 9);
  CHECK(largest_difference((a * b) * p, a * (b * p)) < 1e-12);
}

TEST_CASE("yaw turns the nose right and pitch turns it up and roll puts the right wing down") {
  const double quarter = std::numbers::pi / 2;
  const glm::dvec3 nose(1, 0, 0);
  const glm::dvec3 right_wing(0, 1, 0);
  CHECK(largest_difference(rotation_of({0, 0, quarter}) * nose, {0, 1, 0}) < 1e-15);
  CHECK(largest_difference(rotation_of({0, quarter, 0}) * nose, {0, 0, -1}) < 1e-15);
  CHECK(largest_difference(rotation_of({quarter, 0, 0}) * right_wing, {0, 0, 1}) < 1e-15);
}

TEST_CASE("attitude angles are recovered from their rotation") {
  for (double roll = -3; roll <= 3; roll += 0.75)
    for (double pitch = -1.5; pitch <= 1.5; pitch += 0.5)
      for (double yaw = -3; yaw <= 3; yaw += 0.75) {
        const Attitude back = attitude_of(rotation_of({roll, pitch, yaw}));
        // asin loses half the digits near +-90 degrees; at 1.5 rad some 1e-14 remain
        CHECK(std::fabs(back.roll_rad - roll) < 1e-12);
        CHECK(std::fabs(back.pitch_rad - pitch) < 1e-12);
        CHECK(std::fabs(back.yaw_rad - yaw) < 1e-12);
      }
}

TEST_CASE("straight up and straight down give finite angles that make the same rotation") {
  for (const double pitch : {std::numbers::pi / 2, -std::numbers::pi / 2})
    for (const double yaw : {0.0, 1.0, -2.5}) {
      const glm::dquat rotation = rotation_of({0.4, pitch, yaw});
      const Attitude angles = attitude_of(rotation);
      CHECK(angles.roll_rad == 0);
      const glm::dquat again = rotation_of(angles);
      CHECK(std::fabs(std::fabs(glm::dot(rotation, again)) - 1) < 1e-9);
    }
}

TEST_CASE("the optical frame has x to the right and y down and z forward") {
  CHECK(optical_of({10, 2, 3}) == glm::dvec3(2, 3, 10));
  CHECK(camera_of(optical_of({10, 2, 3})) == glm::dvec3(10, 2, 3));
}

TEST_CASE("degrees and radians are each other's inverse") {
  CHECK(rad_of_deg(180) == doctest::Approx(std::numbers::pi).epsilon(1e-15));
  CHECK(deg_of_rad(rad_of_deg(57.3)) == doctest::Approx(57.3).epsilon(1e-15));
}

TEST_CASE("a rotation survives its angles as closely at the vertical as elsewhere") {
  // Truth: the product of three elementary matrices, written out.
  const auto matrix = [](double roll, double pitch, double yaw) {
    const glm::dmat3 about_x{{1, 0, 0}, {0, std::cos(roll), std::sin(roll)}, {0, -std::sin(roll), std::cos(roll)}};
    const glm::dmat3 about_y{{std::cos(pitch), 0, -std::sin(pitch)}, {0, 1, 0}, {std::sin(pitch), 0, std::cos(pitch)}};
    const glm::dmat3 about_z{{std::cos(yaw), std::sin(yaw), 0}, {-std::sin(yaw), std::cos(yaw), 0}, {0, 0, 1}};
    return about_z * about_y * about_x;
  };
  double largest = 0;
  for (const double side : {-1.0, 1.0})
    for (int power = 0; power <= 17; ++power)
      for (const double roll : {-2.5, -0.3, 0.0, 1.1, 3.0})
        for (const double yaw : {-2.9, 0.0, 0.4, 1.9}) {
          const glm::dmat3 truth = matrix(roll, side * (std::acos(0.0) - std::pow(10.0, -power)), yaw);
          const glm::dmat3 back = glm::mat3_cast(rotation_of(attitude_of(glm::quat_cast(truth))));
          for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
              largest = std::max(largest, std::abs(back[column][row] - truth[column][row]));
        }
  CHECK(largest < 1e-11);  // the roll is dropped where the nose is less than 1e-12 beside the vertical
}
