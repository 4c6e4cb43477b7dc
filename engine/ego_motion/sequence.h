// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace sigs {

// Numbers without order, the same each time (Numerical Recipes' quick generator).
class Sequence {
 public:
  // 0 to count - 1; count > 0.
  std::size_t below(std::size_t count) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>(state_ >> 33) % count;
  }

 private:
  std::uint64_t state_ = 1;
};

}  // namespace sigs
