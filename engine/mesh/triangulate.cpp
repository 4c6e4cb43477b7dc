// SPDX-License-Identifier: MIT
#include "mesh/triangulate.h"

#include <cmath>
#include <cstddef>
#include <numeric>

namespace sigs {
namespace {

// Newell's method: right for concave and slightly bent polygons too.
glm::dvec3 normal_of(std::span<const glm::vec3> corners) {
  glm::dvec3 normal{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 here = corners[i] - corners[0];
    const glm::dvec3 next = corners[(i + 1) % corners.size()] - corners[0];
    normal += glm::cross(here, next);
  }
  return normal;
}

// The polygon seen along the axis in which its normal is longest, so that it runs counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners) {
  const glm::dvec3 normal = normal_of(corners);
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& corner : corners)
    flat.push_back(normal[axis] >= 0 ? glm::dvec2{corner[u], corner[v]} : glm::dvec2{corner[v], corner[u]});
  return flat;
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  if (p == a || p == b || p == c) return false;
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

bool is_ear(const std::vector<glm::dvec2>& flat, const std::vector<int>& left, std::size_t i) {
  const std::size_t count = left.size();
  const glm::dvec2 a = flat[left[(i + count - 1) % count]];
  const glm::dvec2 b = flat[left[i]];
  const glm::dvec2 c = flat[left[(i + 1) % count]];
  if (!(turn(a, b, c) > 0)) return false;
  for (const int other : left)
    if (inside(flat[other], a, b, c)) return false;
  return true;
}

// Where no ear is found the polygon crosses itself or has no area; any corner will do.
std::size_t next_ear(const std::vector<glm::dvec2>& flat, const std::vector<int>& left) {
  for (std::size_t i = 0; i < left.size(); ++i)
    if (is_ear(flat, left, i)) return i;
  return 0;
}

}  // namespace

std::vector<std::array<int, 3>> triangulated(std::span<const glm::vec3> corners) {
  if (corners.size() < 3) return {};
  if (corners.size() == 3) return {{0, 1, 2}};
  const std::vector<glm::dvec2> flat = flattened(corners);
  std::vector<int> left(corners.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<std::array<int, 3>> triangles;
  while (left.size() > 3) {
    const std::size_t ear = next_ear(flat, left);
    const std::size_t count = left.size();
    triangles.push_back({left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace sigs
