// SPDX-License-Identifier: MIT
#include "base/point_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

namespace sigs::test {
namespace {

std::vector<glm::vec3> cloud(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(10 * uniform(random), uniform(random), 100 + 3 * uniform(random));
  return points;
}

std::vector<glm::vec3> sorted(std::vector<glm::vec3> points) {
  std::ranges::sort(
      points, [](const glm::vec3& a, const glm::vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return points;
}

void check_holds(const PointTree::Node& node, const std::vector<glm::vec3>& points) {
  for (std::size_t i = node.first; i < node.first + node.count; ++i) {
    const glm::dvec3 apart = glm::abs(glm::dvec3(points[i]) - node.center);
    CHECK(glm::all(glm::lessThanEqual(apart, node.half + 1e-12)));
    CHECK(glm::length(apart) <= node.radius + 1e-12);
  }
  CHECK(node.radius <= glm::length(node.half) + 1e-12);
}

}  // namespace

TEST_CASE("every point is in one leaf, and every node's bounds hold its points") {
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{9}, std::size_t{1000}}) {
    const std::vector<glm::vec3> given = cloud(count, 3);
    std::vector<glm::vec3> points = given;
    const PointTree tree = tree_of(points);
    CHECK(sorted(points) == sorted(given));
    std::vector<int> times(count, 0);
    for (const PointTree::Node& node : tree.nodes) {
      check_holds(node, points);
      if (node.is_leaf()) {
        CHECK(node.count <= 8);
        for (std::size_t i = 0; i < node.count; ++i) ++times[node.first + i];
        continue;
      }
      const PointTree::Node& left = tree.nodes[node.left];
      const PointTree::Node& right = tree.nodes[node.right];
      CHECK(left.first == node.first);
      CHECK(right.first == left.first + left.count);
      CHECK(left.count + right.count == node.count);
    }
    CHECK(std::ranges::all_of(times, [](int n) { return n == 1; }));
    CHECK(tree.nodes.front().count == count);
  }
}

TEST_CASE("the tree of no points is empty, and equal points end in leaves all the same") {
  std::vector<glm::vec3> none;
  CHECK(tree_of(none).nodes.empty());
  std::vector<glm::vec3> equal(100, glm::vec3(1, 2, 3));
  const PointTree tree = tree_of(equal);
  CHECK(tree.nodes.size() > 10);
  CHECK(tree.nodes.front().radius == 0);
}

TEST_CASE("points that are not finite have no bounds") {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::vector<glm::vec3> points = cloud(100, 5);
    points[50].y = bad;
    const PointTree tree = tree_of(points);
    REQUIRE(tree.nodes.size() == 1);
    CHECK(tree.nodes[0].is_leaf());
    CHECK(tree.nodes[0].count == 100);
    CHECK(tree.nodes[0].radius == std::numeric_limits<double>::infinity());
  }
}

}  // namespace sigs::test
