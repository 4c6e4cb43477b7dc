// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace sigs::footage {

// Repeatable random functions: everything in the image follows from these, without state and without a clock.

// A hash: neighbouring inputs give unrelated numbers.
[[nodiscard]] inline std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0xb5297a4dU;
  x ^= x >> 14;
  x *= 0x68e31da5U;
  return x ^ (x >> 16);
}
[[nodiscard]] inline std::uint32_t hash(int x, int y, std::uint32_t seed) {
  return hash(hash(hash(seed) + static_cast<std::uint32_t>(x)) + static_cast<std::uint32_t>(y));
}
// 0..1
[[nodiscard]] inline float chance(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * (1.0F / 16777216.0F);
}
[[nodiscard]] inline float chance(int x, int y, std::uint32_t seed) {
  return chance(hash(x, y, seed));
}

[[nodiscard]] inline float smooth(float low, float high, float x) {
  const float t = glm::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

// Gradient noise (Perlin 2002), about -0.7..0.7, features of size 1.
[[nodiscard]] float gradient_noise(const glm::dvec2& p, std::uint32_t seed);

// Sum of octaves, each twice as fine and half as strong as the one before; about -1..1.
[[nodiscard]] float fractal_noise(const glm::dvec2& p, int octaves, std::uint32_t seed);

// Voronoi cells around one jittered point in each unit square.
struct CellHit {
  std::uint32_t id = 0;
  float to_centre = 0;  // distance to the nearest point
  float to_border = 0;  // distance to the border with the next cell
  glm::vec2 offset{0};  // from the nearest point to p
};
[[nodiscard]] CellHit cell_at(const glm::dvec2& p, std::uint32_t seed);

}  // namespace sigs::footage
