// SPDX-License-Identifier: MIT
#include "base/random.h"

#include <doctest/doctest.h>

#include <cstdint>

using namespace sigs;

namespace {

// The inverse of SplitMix64's output function, to start a generator at a known state.
std::uint64_t unmixed(std::uint64_t z) {
  const auto inverse = [](std::uint64_t odd) {  // modulo 2^64, by Newton's method
    std::uint64_t x = odd;
    for (int i = 0; i < 6; ++i) x *= 2 - odd * x;
    return x;
  };
  z ^= (z >> 31) ^ (z >> 62);
  z *= inverse(0x94d049bb133111eb);
  z ^= (z >> 27) ^ (z >> 54);
  z *= inverse(0xbf58476d1ce4e5b9);
  return z ^ (z >> 30) ^ (z >> 60);
}

}  // namespace

TEST_CASE("the generator is SplitMix64: from the state 1234567 it gives the numbers that others publish") {
  Random random(unmixed(unmixed(1234567)));
  CHECK(random.bits() == 6457827717110365317U);
  CHECK(random.bits() == 3203168211198807973U);
  CHECK(random.bits() == 9817491932198370423U);
  CHECK(Random(1, 0).bits() != Random(1, 1).bits());
  CHECK(Random(1, 0).bits() != Random(2, 0).bits());
}
