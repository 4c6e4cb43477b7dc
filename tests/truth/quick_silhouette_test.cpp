// SPDX-License-Identifier: MIT
#include "truth/quick_silhouette.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "camera/example_lenses.h"

namespace sigs::test {
namespace {

using CameraFromBody = Pose<frame::Camera, frame::Body>;

struct Body {
  std::vector<glm::vec3> points;
  PointTree tree;
};

Body body_of(std::vector<glm::vec3> points) {
  Body body{.points = std::move(points)};
  body.tree = tree_of(body.points);
  return body;
}

// The skin of a fuselage, 20 m long, and thin wings 20 m wide.
Body aircraft_like(int count) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count;
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = 1.2 * std::sqrt(1 - std::pow(2 * share - 1, 2));
    points.emplace_back(20 * share - 10, r * std::cos(turn), r * std::sin(turn));
    points.emplace_back(std::cos(turn), 20 * share - 10, 0.05 * std::sin(turn));
  }
  return body_of(std::move(points));
}

Body cloud(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-8, 8);
  std::vector<glm::vec3> points;
  for (int i = 0; i < count; ++i) points.emplace_back(uniform(random), uniform(random), uniform(random));
  return body_of(std::move(points));
}

// Anywhere in and beyond the lens' field, 1 m to 100 km away, turned anyhow.
CameraFromBody any_pose(const Lens& lens, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const double angle_rad = std::min(1.2 * lens.valid_angle_rad(), std::numbers::pi) * uniform(random);
  const double distance_m = std::pow(10, 5 * uniform(random));
  return {glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))),
          distance_m * direction(angle_rad, 2 * std::numbers::pi * uniform(random))};
}

bool is_same(const std::optional<Silhouette>& a, const std::optional<Silhouette>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->all_have_image == b->all_have_image && a->box.x == b->box.x && a->box.y == b->box.y &&
         a->box.width == b->box.width && a->box.height == b->box.height;
}

struct Tally {
  int whole = 0;
  int in_part = 0;
  int none = 0;
  int different = 0;
};

void compare(const Body& body, const CameraFromBody& pose, const Lens& lens, Tally& tally) {
  const auto wanted = silhouette_of(body.points, pose, lens);
  const QuickSilhouette found = silhouette_of(body.points, body.tree, pose, lens);
  tally.different += !is_same(found.silhouette, wanted);
  ++(!wanted ? tally.none : wanted->all_have_image ? tally.whole : tally.in_part);
}

}  // namespace

TEST_CASE("the quick silhouette is that of all points to the last bit, whatever the lens and the pose") {
  const Body bodies[] = {aircraft_like(500), cloud(300)};
  std::mt19937 random(1);
  Tally all;
  for (const auto& [name, lens, size] : all_lenses()) {
    CAPTURE(name);
    Tally tally;
    for (int i = 0; i < 300; ++i) compare(bodies[i % 2], any_pose(lens, random), lens, tally);
    CHECK(tally.different == 0);
    CHECK(tally.whole > 30);
    all.in_part += tally.in_part;
    all.none += tally.none;
  }
  CHECK(all.in_part > 100);
  CHECK(all.none > 100);
}

TEST_CASE("the quick silhouette is that of all points around the camera and across the rim of the field") {
  const Body body = aircraft_like(500);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  Tally all;
  for (const auto& [name, lens, size] : all_lenses()) {
    CAPTURE(name);
    Tally tally;
    for (int i = 0; i < 60; ++i) {
      CameraFromBody pose = any_pose(lens, random);
      const double distance_m = 12 * uniform(random);
      pose.translation_m = distance_m * glm::normalize(pose.translation_m);
      compare(body, pose, lens, tally);
      // Its middle on the rim.
      pose.translation_m =
          (20 + 1e3 * uniform(random)) *
          direction(lens.valid_angle_rad() * (1 + 1e-3 * (uniform(random) - 0.5)), 6 * uniform(random));
      compare(body, pose, lens, tally);
    }
    CHECK(tally.different == 0);
    all.in_part += tally.in_part;
  }
  CHECK(all.in_part > 1000);
}

TEST_CASE("far away and with a place or points that are none the quick silhouette is that of all points") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Body broken = cloud(50);
  broken.points[17].x = std::numeric_limits<float>::quiet_NaN();
  broken = body_of(broken.points);
  const Body bodies[] = {aircraft_like(200), broken, body_of({{1, 2, 3}}), body_of({{1, 2, 3}, {1, 2, 3}}),
                         body_of({})};
  Tally tally;
  for (const auto& [name, lens, size] : example_lenses())
    for (const Body& body : bodies)
      for (const glm::dvec3& place : {glm::dvec3(1e7, 1e5, 3e5), glm::dvec3(1e7, 0, 0), glm::dvec3(-1e7, 0, 0),
                                      glm::dvec3(0, 0, 0), glm::dvec3(kNan, 0, 0), glm::dvec3(kInfinity, 0, 0)})
        compare(body, {glm::dquat(0.5, 0.5, -0.5, 0.5), place}, lens, tally);
  CHECK(tally.different == 0);
  CHECK(tally.whole > 50);
}

TEST_CASE("the lens is asked in proportion to what it has to be asked") {
  const Body body = aircraft_like(10000);
  std::mt19937 random(4);
  for (const auto& [name, lens, size] : all_lenses()) {
    CAPTURE(name);
    for (int i = 0; i < 20; ++i) {
      CameraFromBody pose = any_pose(lens, random);
      pose.translation_m = 300.0 * direction(0.7 * std::min(lens.valid_angle_rad(), 1.2), i);
      const QuickSilhouette found = silhouette_of(body.points, body.tree, pose, lens);
      REQUIRE(found.silhouette.has_value());
      // 20000 points.
      CHECK(found.lens_evaluations > 4);
      CHECK(found.lens_evaluations < 1000);
    }
  }
}

}  // namespace sigs::test
