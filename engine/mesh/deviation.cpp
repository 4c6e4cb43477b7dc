// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "mesh/simplified.h"

namespace sigs {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

// Shares of the corners in the point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
glm::dvec3 nearest_shares(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const double d1 = glm::dot(ab, p - a);
  const double d2 = glm::dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = glm::dot(ab, p - b);
  const double d4 = glm::dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = glm::dot(ab, p - c);
  const double d6 = glm::dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double share = (d4 - d3) / (d4 - d3 + d5 - d6);
    return {0, 1 - share, share};
  }
  const double sum = va + vb + vc;
  return {1 - (vb + vc) / sum, vb / sum, vc / sum};
}

// Triangles by the cells of a grid that they come near to.
class Grid {
 public:
  Grid(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices, double near_m)
      : vertices_(vertices), indices_(indices), near_m_(near_m) {
    for (const std::uint32_t index : indices) {
      low_m_ = glm::min(low_m_, glm::dvec3(vertices[index].position_m));
      high_m_ = glm::max(high_m_, glm::dvec3(vertices[index].position_m));
    }
    low_m_ -= near_m;
    const double extent_m = std::max({high_m_.x - low_m_.x, high_m_.y - low_m_.y, high_m_.z - low_m_.z}) + near_m;
    const double wanted = std::clamp(std::cbrt(4.0 * double(indices.size())), 4.0, 128.0);
    cell_m_ = std::max(extent_m / wanted, 2 * near_m);
    side_ = static_cast<int>(extent_m / cell_m_) + 1;
    cells_.resize(static_cast<std::size_t>(side_) * side_ * side_);
    for (std::size_t first = 0; first + 2 < indices.size(); first += 3) enter(first);
  }

  [[nodiscard]] const std::vector<std::uint32_t>& near(const glm::dvec3& p_m) const {
    const glm::ivec3 at = cell_of(p_m);
    return cells_[index_of(at.x, at.y, at.z)];
  }

 private:
  void enter(std::size_t first) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(vertices_[indices_[first + i]].position_m); };
    const glm::ivec3 from = cell_of(glm::min(glm::min(corner(0), corner(1)), corner(2)) - near_m_);
    const glm::ivec3 to = cell_of(glm::max(glm::max(corner(0), corner(1)), corner(2)) + near_m_);
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) cells_[index_of(x, y, z)].push_back(static_cast<std::uint32_t>(first));
  }
  [[nodiscard]] glm::ivec3 cell_of(const glm::dvec3& p_m) const {
    return glm::clamp(glm::ivec3(glm::floor((p_m - low_m_) / cell_m_)), glm::ivec3(0), glm::ivec3(side_ - 1));
  }
  [[nodiscard]] std::size_t index_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * side_ + y) * side_ + x;
  }

  std::span<const Vertex> vertices_;
  std::span<const std::uint32_t> indices_;
  double near_m_;
  glm::dvec3 low_m_{kNowhere};
  glm::dvec3 high_m_{-kNowhere};
  double cell_m_ = 1;
  int side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

using Corners = std::array<const Vertex*, 3>;

// Metres on the surface that a step in the picture stands for.
double meters_of_uv(const Corners& t, const glm::dvec2& step) {
  const glm::dvec2 u1(t[1]->uv - t[0]->uv);
  const glm::dvec2 u2(t[2]->uv - t[0]->uv);
  const double area = u1.x * u2.y - u1.y * u2.x;
  if (step == glm::dvec2(0)) return 0;
  if (area == 0) return kNowhere;
  const double along_1 = (step.x * u2.y - step.y * u2.x) / area;
  const double along_2 = (u1.x * step.y - u1.y * step.x) / area;
  return glm::length(along_1 * glm::dvec3(t[1]->position_m - t[0]->position_m) +
                     along_2 * glm::dvec3(t[2]->position_m - t[0]->position_m));
}

double distance_m(const Vertex& vertex, const Corners& t, bool is_pictured) {
  const glm::dvec3 p(vertex.position_m);
  const glm::dvec3 a(t[0]->position_m);
  const glm::dvec3 b(t[1]->position_m);
  const glm::dvec3 c(t[2]->position_m);
  const glm::dvec3 share = nearest_shares(p, a, b, c);
  const double off_m = glm::distance(p, share.x * a + share.y * b + share.z * c);
  if (!is_pictured) return off_m;
  const glm::dvec2 uv =
      share.x * glm::dvec2(t[0]->uv) + share.y * glm::dvec2(t[1]->uv) + share.z * glm::dvec2(t[2]->uv);
  return std::max(off_m, meters_of_uv(t, glm::dvec2(vertex.uv) - uv));
}

}  // namespace

double deviation_m(std::span<const Vertex> vertices, std::span<const std::uint32_t> whole,
                   std::span<const std::uint32_t> simple, bool is_pictured, double at_most_m) {
  if (whole.empty()) return 0;
  if (simple.empty()) return kNowhere;
  std::vector<char> is_open(vertices.size(), 0);  // to be looked at yet
  for (const std::uint32_t index : whole) is_open[index] = 1;
  for (const std::uint32_t index : simple) is_open[index] = 0;
  const Grid grid(vertices, simple, at_most_m);
  double worst_m = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (is_open[v] == 0) continue;
    double least_m = kNowhere;
    for (const std::uint32_t first : grid.near(vertices[v].position_m)) {
      const Corners t{&vertices[simple[first]], &vertices[simple[first + 1]], &vertices[simple[first + 2]]};
      least_m = std::min(least_m, distance_m(vertices[v], t, is_pictured));
    }
    worst_m = std::max(worst_m, least_m);
    if (worst_m > at_most_m) return kNowhere;
  }
  return worst_m;
}

}  // namespace sigs
