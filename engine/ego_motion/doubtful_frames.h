// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "ego_motion/ego_motion.h"

namespace sigs {

// Looks for runs of repeated frames too long for a doubled one, of which nothing can be known; marks them lost and all
// that follows unknown; then adds the warnings that name frames: lost, cut, repeated, no horizon.
void add_doubtful_frames(EgoMotion& motion, const std::string& where);

// "3-7, 12 and 20 more": rising numbers as ranges, the first ten of them.
[[nodiscard]] std::string ranges_text(std::span<const int> numbers);

}  // namespace sigs
