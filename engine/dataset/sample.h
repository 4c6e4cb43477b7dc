// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace sigs {

// What is made of quantities or of what a recipe says, or the reason why there is no such thing, in one line.
template <class T>
using Possible = tl::expected<T, std::string>;

// A number that is fixed, or sampled for each video. docs/dataset-recipe.md shows how recipes write it.
struct Quantity {
  enum class Kind { fixed, uniform, log_uniform, normal, choice };
  Kind kind = Kind::fixed;
  double value = 0;                // fixed
  double low = 0, high = 0;        // uniform, log_uniform: [low, high); normal: bounds of truncation, may be infinite
  double mean = 0, deviation = 0;  // normal, before it is truncated to its bounds
  std::vector<double> choices;     // choice: with equal probability

  [[nodiscard]] bool operator==(const Quantity&) const = default;
};

// What a random number is for. The same key always gives the same number, so no number depends on the order of samples
// or on how many there are.
struct SampleKey {
  std::uint64_t seed = 0;  // any value, 0 too
  std::string_view what;   // the video's name
  std::string_view which;  // the quantity's name
};

// 64 random bits of a key: SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014)
// started from a hash of all three parts (FNV-1a, with one step of SplitMix64 after each text). Integer arithmetic
// alone, so every machine gives the same bits.
[[nodiscard]] std::uint64_t random_bits(const SampleKey& key);

// Uniform in [0, 1), multiples of 2^-53.
[[nodiscard]] double random_share(const SampleKey& key);

// The quantity's value for a key. Fixed values are returned unchanged; a normal one is the inverse of its cumulative
// distribution, truncated (not clamped) to its bounds.
[[nodiscard]] double sampled(const Quantity& quantity, const SampleKey& key);

// An interval of values, both ends included.
struct Span {
  double low = 0;
  double high = 0;
};

// Lowest and highest value that a quantity can have; infinite for a normal one without bounds.
[[nodiscard]] Span span_of(const Quantity& quantity);

}  // namespace sigs
