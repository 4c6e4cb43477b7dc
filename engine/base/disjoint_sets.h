// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sigs {

// Disjoint sets of the numbers 0 .. count - 1, each alone in its set at first (union-find with path halving; Tarjan
// and van Leeuwen 1984). Two numbers are in the same set where root() returns the same for both.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  // The representative of the set; any join() may change it.
  std::uint32_t root(std::uint32_t of) {
    while (parent_[of] != of) of = parent_[of] = parent_[parent_[of]];
    return of;
  }

  // Unites the sets of a and b. The root of b's set becomes the root of both.
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace sigs
