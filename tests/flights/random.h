// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sigs::flights {

// Repeatable random numbers without state: all randomness of a flight comes from these.

// A hash: neighbouring inputs give unrelated numbers.
[[nodiscard]] constexpr std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 15)) * 0x2c1b3c6dU;
  x = (x ^ (x >> 12)) * 0x297a2d39U;
  return x ^ (x >> 15);
}
[[nodiscard]] constexpr std::uint32_t mixed(int a, int b, std::uint32_t seed) {
  return mixed(mixed(mixed(seed) + static_cast<std::uint32_t>(a)) + static_cast<std::uint32_t>(b));
}
// A random number, 0..1, of two numbers and a seed.
[[nodiscard]] constexpr double random_share(int a, int b, std::uint32_t seed) {
  return static_cast<double>(mixed(a, b, seed) >> 8) / 16777216.0;
}

}  // namespace sigs::flights
