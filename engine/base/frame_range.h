// SPDX-License-Identifier: MIT
#pragma once

namespace sigs {

// Frames of the footage, counted from 0.
struct FrameRange {
  int first = 0;
  int last = 0;  // included
};

}  // namespace sigs
