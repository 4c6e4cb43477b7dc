// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace sigs::made {

// Repeatable random numbers without state: everything in a flight follows from its seed.

// A hash: neighbouring inputs give unrelated numbers.
[[nodiscard]] constexpr std::uint32_t scrambled(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}
[[nodiscard]] constexpr std::uint32_t scrambled(int a, int b, std::uint32_t seed) {
  return scrambled(scrambled(scrambled(seed) + static_cast<std::uint32_t>(a)) + static_cast<std::uint32_t>(b));
}

// Even, 0..1.
[[nodiscard]] constexpr double even(int a, int b, std::uint32_t seed) {
  return (static_cast<double>(scrambled(a, b, seed)) + 0.5) / 4294967296.0;
}

// Normal with mean 0 and standard deviation 1 (Box and Muller 1958).
[[nodiscard]] inline double normal(int a, int b, std::uint32_t seed) {
  const double radius = std::sqrt(-2 * std::log(even(a, b, seed)));
  return radius * std::cos(2 * std::numbers::pi * even(a, b, seed + 0x51ed27U));
}

}  // namespace sigs::made
