// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/recipe.h"

namespace sigs {

// The properties of a video that determine its split.
struct SplitCandidate {
  std::string video;
  std::string fixed;  // the split that its group names; empty: it is assigned
  std::string unit;   // candidates of one unit get the same split; empty: a unit of its own
};

// The split of each candidate. A unit with a fixed member gets that member's split. The others are sorted by size, the
// largest first, and by a hash of seed and name, and each in turn goes to the split that is farthest below its share of
// the videos; for units of one size that is the method of the largest remainder. Without shares, units without a fixed
// member get "". Error bad_data, with an empty place: one unit has two fixed splits.
[[nodiscard]] Result<std::vector<std::string>> splits_of(std::span<const SplitCandidate> candidates,
                                                         std::span<const SplitShare> shares, std::uint64_t seed);

}  // namespace sigs
