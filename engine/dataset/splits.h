// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/recipe.h"

namespace sigs {

// A video, as far as splits look at it.
struct SplitCandidate {
  std::string video;
  std::string fixed;  // the split that its group names; empty: sampled
  std::string unit;   // candidates of one unit share a split; empty: it stands alone
};

// The split of each candidate. Units with a fixed member follow it whole. The others are put in the order of a hash of
// seed and name, larger units first, and each goes to the split that is still farthest from its share of them; for
// units of one size that is the method of the largest remainder. No shares: "" for whoever is not fixed. Error
// bad_data, where empty: one unit with two fixed splits.
[[nodiscard]] Result<std::vector<std::string>> splits_of(std::span<const SplitCandidate> candidates,
                                                         std::span<const SplitShare> shares, std::uint64_t seed);

}  // namespace sigs
