// SPDX-License-Identifier: MIT
#pragma once

#include "world_lock/clip.h"

namespace sigs::bench {

// How far the image of a clip moves, by the median displacement of corners all over it, without own body and moving
// boxes.
struct ImageMotion {
  double step_rms_px = 0;  // from frame to frame, of frames with enough corners
  double range_px = 0;     // extent of the summed displacement, the larger of x and y
  double tracked = 0;      // share of frames with enough corners
};

[[nodiscard]] ImageMotion image_motion(const Clip& clip);

// Whether a clip's image can be followed, and moves: below that nothing could slip.
inline constexpr double kMinTracked = 0.5;
inline constexpr double kMinRange_px = 3;

}  // namespace sigs::bench
