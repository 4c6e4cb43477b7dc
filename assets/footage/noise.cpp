// SPDX-License-Identifier: MIT
#include "noise.h"

#include <cmath>

namespace sigs::footage {

namespace {

float corner(int x, int y, std::uint32_t seed, float dx, float dy) {
  constexpr float kDiagonal = 0.70710678F;
  static constexpr float kX[8] = {1, kDiagonal, 0, -kDiagonal, -1, -kDiagonal, 0, kDiagonal};
  static constexpr float kY[8] = {0, kDiagonal, 1, kDiagonal, 0, -kDiagonal, -1, -kDiagonal};
  const std::uint32_t way = hash(x, y, seed) >> 29;
  return kX[way] * dx + kY[way] * dy;
}

glm::vec2 point_in_cell(int x, int y, std::uint32_t seed) {
  const std::uint32_t bits = hash(x, y, seed);
  return {0.1F + 0.8F * chance(bits), 0.1F + 0.8F * chance(hash(bits))};
}

}  // namespace

float gradient_noise(const glm::dvec2& p, std::uint32_t seed) {
  const double fx = std::floor(p.x), fy = std::floor(p.y);
  const int x = static_cast<int>(fx), y = static_cast<int>(fy);
  const float dx = static_cast<float>(p.x - fx), dy = static_cast<float>(p.y - fy);
  const float u = dx * dx * dx * (dx * (dx * 6 - 15) + 10), v = dy * dy * dy * (dy * (dy * 6 - 15) + 10);
  const float upper = glm::mix(corner(x, y, seed, dx, dy), corner(x + 1, y, seed, dx - 1, dy), u);
  const float lower = glm::mix(corner(x, y + 1, seed, dx, dy - 1), corner(x + 1, y + 1, seed, dx - 1, dy - 1), u);
  return glm::mix(upper, lower, v);
}

float fractal_noise(const glm::dvec2& p, int octaves, std::uint32_t seed) {
  float sum = 0, strength = 1;
  glm::dvec2 q = p;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * gradient_noise(q, seed + static_cast<std::uint32_t>(i));
    strength *= 0.5F;
    q = {1.6 * q.x + 1.2 * q.y + 17.3,
         -1.2 * q.x + 1.6 * q.y - 9.1};  // rotated, so that the grid of the noise is not visible
  }
  return sum;
}

CellHit cell_at(const glm::dvec2& p, std::uint32_t seed) {
  const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
  const glm::vec2 here{static_cast<float>(p.x - x), static_cast<float>(p.y - y)};
  CellHit hit;
  glm::vec2 nearest{0};
  float best = 1e9F;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const glm::vec2 to = glm::vec2(i, j) + point_in_cell(x + i, y + j, seed) - here;
      if (const float d = glm::dot(to, to); d < best) {
        best = d;
        nearest = to;
        hit.id = hash(x + i, y + j, seed ^ 0x9e3779b9U);
      }
    }
  hit.to_centre = std::sqrt(best);
  hit.offset = -nearest;
  hit.to_border = 1e9F;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const glm::vec2 to = glm::vec2(i, j) + point_in_cell(x + i, y + j, seed) - here;
      const glm::vec2 apart = to - nearest;
      if (glm::dot(apart, apart) < 1e-6F) continue;
      hit.to_border = glm::min(hit.to_border, glm::dot(0.5F * (to + nearest), glm::normalize(apart)));
    }
  return hit;
}

}  // namespace sigs::footage
