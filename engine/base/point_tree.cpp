// SPDX-License-Identifier: MIT
#include "base/point_tree.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace sigs {

namespace {

constexpr std::size_t kMaxInGroup = 12;

struct Extent {
  glm::vec3 low, high;
};

Extent extent_of(std::span<const glm::vec3> points) {
  Extent extent{points.front(), points.front()};
  for (const glm::vec3& point : points) {
    extent.low = glm::min(extent.low, point);
    extent.high = glm::max(extent.high, point);
  }
  return extent;
}

// The middle is the point nearest to the middle of the extent.
PointTree::Group group_of(std::span<const glm::vec3> points, const Extent& extent, std::size_t first) {
  const glm::vec3 center = 0.5F * (extent.low + extent.high);
  const auto squared = [](const glm::dvec3& v) { return glm::dot(v, v); };
  const glm::vec3 middle = *std::min_element(points.begin(), points.end(), [&](const glm::vec3& a, const glm::vec3& b) {
    return squared(glm::dvec3(a) - glm::dvec3(center)) < squared(glm::dvec3(b) - glm::dvec3(center));
  });
  double most = 0;
  for (const glm::vec3& point : points) most = std::max(most, squared(glm::dvec3(point) - glm::dvec3(middle)));
  return {.middle_m = middle, .radius_m = std::sqrt(most), .first = first, .count = points.size()};
}

// The points before the middle one along the longest side come first.
void sort_halves(std::span<glm::vec3> points, const Extent& extent) {
  const glm::vec3 sides = extent.high - extent.low;
  int longest = 0;
  for (const int axis : {1, 2})
    if (sides[axis] > sides[longest]) longest = axis;
  std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2), points.end(),
                   [longest](const glm::vec3& a, const glm::vec3& b) { return a[longest] < b[longest]; });
}

}  // namespace

PointTree point_tree_of(std::vector<glm::vec3> points_m) {
  PointTree tree{.points_m = std::move(points_m)};
  if (tree.points_m.empty()) return tree;
  tree.groups.push_back({.count = tree.points_m.size()});
  for (std::size_t i = 0; i < tree.groups.size(); ++i) {
    const std::size_t first = tree.groups[i].first, count = tree.groups[i].count;
    const std::span<glm::vec3> points(tree.points_m.data() + first, count);
    const Extent extent = extent_of(points);
    tree.groups[i] = group_of(points, extent, first);
    if (count <= kMaxInGroup) continue;
    sort_halves(points, extent);
    tree.groups[i].halves = tree.groups.size();
    tree.groups.push_back({.first = first, .count = count / 2});
    tree.groups.push_back({.first = first + count / 2, .count = count - count / 2});
  }
  return tree;
}

}  // namespace sigs
