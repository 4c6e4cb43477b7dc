// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sigs {

// SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014): what its state grows by, and
// its output function of a state.
inline constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15;
[[nodiscard]] constexpr std::uint64_t splitmix64(std::uint64_t state) {
  state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9;
  state = (state ^ (state >> 27)) * 0x94d049bb133111eb;
  return state ^ (state >> 31);
}

// Random numbers with a sequence that is fixed by the seed, the same with every compiler and on every machine: integer
// arithmetic alone, and none of the standard library's distributions, whose results are not prescribed. The generator
// is SplitMix64, period 2^64.
class Random {
 public:
  // Generators with the same seed and another stream give unrelated sequences. A stream for each track makes the tracks
  // independent of how many there are and in what order they are made.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(splitmix64(splitmix64(seed) + kSplitMixStep * stream)) {}

  // The next 64 random bits.
  [[nodiscard]] std::uint64_t bits() { return splitmix64(state_ += kSplitMixStep); }

  // The next number of [0, 1): a multiple of 2^-53, all equally likely.
  [[nodiscard]] double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

}  // namespace sigs
