// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sigs {

// A number that is fixed, or sampled anew for each video. docs/dataset.md has how each is written.
struct Quantity {
  enum class Kind { fixed, uniform, normal, choice };
  Kind kind = Kind::fixed;
  double value = 0;                // fixed
  double low = 0, high = 0;        // uniform: [low, high); normal: bounds, within which it is sampled; may be infinite
  double mean = 0, deviation = 0;  // normal, before it is cut to its bounds
  std::vector<double> choices;     // choice: each as likely

  [[nodiscard]] bool operator==(const Quantity&) const = default;
};

// Where a random number belongs. The same key always gives the same number, so nothing depends on the order of
// samples or on how many there are.
struct SampleKey {
  std::uint64_t seed = 0;  // 0 is a seed like any other
  std::string_view what;   // the video's name
  std::string_view which;  // the quantity's name
};

// 64 random bits of a key: SplitMix64 (Steele, Lea, Flood 2014) started from a hash of all three (FNV-1a, each text
// closed by one step of SplitMix64). Whole numbers alone, so every machine agrees.
[[nodiscard]] std::uint64_t random_bits(const SampleKey& key);

// Uniform in [0, 1), multiples of 2^-53.
[[nodiscard]] double random_share(const SampleKey& key);

// Fixed values as they are; normal by the inverse of its distribution, cut to its bounds (not heaped at them).
[[nodiscard]] double sampled(const Quantity& quantity, const SampleKey& key);

// Lowest and highest value that a quantity can have.
struct Span {
  double low = 0;
  double high = 0;
};
[[nodiscard]] Span span_of(const Quantity& quantity);

}  // namespace sigs
