// SPDX-License-Identifier: MIT
#include "deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "mesh/surface_deviation.h"

namespace sigs {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

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

}  // namespace

double deviation_m(std::span<const Vertex> vertices, std::span<const std::uint32_t> whole,
                   std::span<const std::uint32_t> simple, bool is_textured, double limit_m) {
  if (whole.empty()) return 0;
  if (simple.empty()) return kNowhere;
  std::vector<char> is_open(vertices.size(), 0);  // to be looked at yet
  for (const std::uint32_t index : whole) is_open[index] = 1;
  for (const std::uint32_t index : simple) is_open[index] = 0;
  const Grid grid(vertices, simple, limit_m);
  double worst_m = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (is_open[v] == 0) continue;
    double min_m = kNowhere;
    for (const std::uint32_t first : grid.near(vertices[v].position_m)) {
      const Corners t{&vertices[simple[first]], &vertices[simple[first + 1]], &vertices[simple[first + 2]]};
      min_m = std::min(min_m, offset_m(vertices[v], t, is_textured, limit_m));
    }
    worst_m = std::max(worst_m, min_m);
    if (worst_m > limit_m) return kNowhere;
  }
  return worst_m;
}

}  // namespace sigs
