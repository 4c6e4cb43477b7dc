// SPDX-License-Identifier: MIT
// The box by groups of points against the box of all points, one by one.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/point_tree.h"
#include "camera/example_lenses.h"
#include "truth/silhouette.h"

namespace sigs::test {
namespace {

struct NamedPoints {
  std::string name;
  std::vector<glm::vec3> points_m;
};

NamedPoints made_points(const std::string& name, int count, const std::function<glm::dvec3(double, double)>& at) {
  NamedPoints made{name, {}};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < count; ++i) made.points_m.emplace_back(at(uniform(random), uniform(random)));
  return made;
}

// Bodies that touch their box with corners, with edges, with round sides, in one point alone, and along a line.
std::vector<NamedPoints> bodies() {
  constexpr double kTurn = 2 * std::numbers::pi;
  std::vector<NamedPoints> all;
  all.push_back(made_points("sphere", 4000, [](double u, double v) {
    const double z = 2 * u - 1, r = std::sqrt(1 - z * z);
    return 5.0 * glm::dvec3(z, r * std::cos(kTurn * v), r * std::sin(kTurn * v));
  }));
  all.push_back(made_points("wing and body", 4000, [](double u, double v) {
    return u < 0.5 ? glm::dvec3(v, 40 * u - 10, 0.1 * v)
                   : glm::dvec3(24 * u - 18, std::cos(kTurn * v), std::sin(kTurn * v));
  }));
  all.push_back(made_points("line", 500, [](double u, double) { return (u - 0.5) * glm::dvec3(3, 14, -7); }));
  all.push_back(made_points("cloud and a far point", 500, [](double u, double v) {
    return u < 0.005 ? glm::dvec3(1, 30, -20) : glm::dvec3(u, v, u * v);
  }));
  all.push_back({"one point", {{1, 2, 3}}});
  all.push_back({"the same point many times", std::vector<glm::vec3>(100, {1, 2, 3})});
  return all;
}

void check_same(const PointTree& tree, const Pose<frame::Camera, frame::Body>& pose, const Lens& lens) {
  const auto each = silhouette_of(std::span(tree.points_m), pose, lens);
  const auto grouped = silhouette_by_groups(tree, pose, lens);
  REQUIRE(grouped.has_value() == each.has_value());
  if (!each) return;
  CHECK(grouped->all_have_image == each->all_have_image);
  CHECK(grouped->box.x == each->box.x);
  CHECK(grouped->box.y == each->box.y);
  CHECK(grouped->box.width == each->box.width);
  CHECK(grouped->box.height == each->box.height);
}

}  // namespace

TEST_CASE("each point belongs to one group of the smallest, and lies within its radius of the middle") {
  for (const NamedPoints& body : bodies()) {
    CAPTURE(body.name);
    const PointTree tree = point_tree_of(body.points_m);
    std::vector<int> owners(body.points_m.size());
    for (const PointTree::Group& group : tree.groups)
      for (std::size_t i = group.first; i < group.first + group.count; ++i) {
        REQUIRE(i < owners.size());
        CHECK(glm::distance(glm::dvec3(tree.points_m[i]), glm::dvec3(group.middle_m)) <= group.radius_m);
        if (group.halves == 0) ++owners[i];
      }
    CHECK(owners == std::vector<int>(owners.size(), 1));
    const auto sorted = [](std::vector<glm::vec3> points) {
      std::sort(points.begin(), points.end(), [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
      });
      return points;
    };
    CHECK(sorted(tree.points_m) == sorted(body.points_m));
  }
  CHECK(point_tree_of({}).groups.empty());
}

TEST_CASE("groups of points have the box of all points through every lens, far and near, at the rim and behind") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<PointTree> trees;
  for (const NamedPoints& body : bodies()) trees.push_back(point_tree_of(body.points_m));
  for (const ExampleLens& example : all_lenses()) {
    CAPTURE(example.name);
    for (const glm::dvec3& towards : directions_over(example.lens, 3, 4, 1.02))
      for (const double distance_m : {2.0, 20.0, 150.0, 2000.0, 1e5}) {
        CAPTURE(distance_m);
        const glm::dquat turn(uniform(random), uniform(random), uniform(random), uniform(random));
        const Pose<frame::Camera, frame::Body> pose{glm::normalize(turn), distance_m * towards};
        check_same(trees[static_cast<std::size_t>(random() % trees.size())], pose, example.lens);
      }
  }
  const Lens lens = lens_of(LensModel::brown_conrady, 900, 900, {640, 480}, {});
  for (const PointTree& tree : trees)
    for (const double x_m : {-100.0, -1.0, 0.0, 1.0}) check_same(tree, {{1, 0, 0, 0}, {x_m, 0, 0}}, lens);
  check_same(trees[0], {{1, 0, 0, 0}, {std::nan(""), 0, 0}}, lens);
  CHECK_FALSE(silhouette_by_groups(PointTree{}, {{1, 0, 0, 0}, {100, 0, 0}}, lens).has_value());
}

TEST_CASE("of a distant body few points pass the lens, however it is turned") {
  const PointTree tree = point_tree_of(bodies()[1].points_m);
  const Lens lens = lens_of(LensModel::brown_conrady, 900, 900, {640, 480}, {-0.2, 0.05, 0.001, 0.001, 0});
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr int kPoses = 200;
  std::int64_t asked = 0;
  for (int i = 0; i < kPoses; ++i) {
    const glm::dquat turn = glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
    const auto grouped = silhouette_by_groups(tree, {turn, {500, 20, 10}}, lens);
    REQUIRE(grouped.has_value());
    asked += grouped->lens_evaluations;
  }
  MESSAGE("of 4000 points ", asked / kPoses, " pass the lens");
  CHECK(asked < kPoses * 4000 / 4);
}

}  // namespace sigs::test
