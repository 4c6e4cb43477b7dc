// SPDX-License-Identifier: MIT
#include "base/point_tree.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace sigs {

namespace {

constexpr std::size_t kMaxInLeaf = 8;

// A total order along one axis, so that the tree depends on the points alone.
struct Along {
  int axis = 0;
  bool operator()(const glm::vec3& a, const glm::vec3& b) const {
    return std::tie(a[axis], a.x, a.y, a.z) < std::tie(b[axis], b.x, b.y, b.z);
  }
};

bool is_finite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

PointTree::Node node_around(std::span<const glm::vec3> points, std::size_t first) {
  glm::dvec3 low(points.front());
  glm::dvec3 high = low;
  for (const glm::vec3& point : points) {
    low = glm::min(low, glm::dvec3(point));
    high = glm::max(high, glm::dvec3(point));
  }
  PointTree::Node node{
      .center = 0.5 * (low + high), .half = 0.5 * (high - low), .first = first, .count = points.size()};
  for (const glm::vec3& point : points)
    node.radius = std::max(node.radius, glm::distance(glm::dvec3(point), node.center));
  return node;
}

std::size_t grow(std::vector<PointTree::Node>& nodes, std::span<glm::vec3> points, std::size_t first) {
  const std::size_t at = nodes.size();
  nodes.push_back(node_around(points, first));
  const glm::dvec3 half = nodes[at].half;
  if (points.size() <= kMaxInLeaf) return at;
  const int axis = half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
  const std::size_t middle = points.size() / 2;
  std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(middle), points.end(), Along{axis});
  const std::size_t left = grow(nodes, points.first(middle), first);
  const std::size_t right = grow(nodes, points.subspan(middle), first + middle);
  nodes[at].left = left;
  nodes[at].right = right;
  return at;
}

}  // namespace

PointTree tree_of(std::vector<glm::vec3>& points) {
  PointTree tree;
  if (points.empty()) return tree;
  if (!std::ranges::all_of(points, is_finite)) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    tree.nodes.push_back({.half = glm::dvec3(kInfinity), .radius = kInfinity, .count = points.size()});
    return tree;
  }
  grow(tree.nodes, points, 0);
  return tree;
}

}  // namespace sigs
