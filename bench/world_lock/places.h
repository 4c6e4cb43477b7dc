// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "world_lock/clip.h"

namespace sigs::bench {

// Where intruders are put in a frame: up to `count` pixels within the far background whose neighbourhood has the most
// texture in its weaker direction, so that it can be followed both ways, 60 px or more apart. None where no
// neighbourhood has texture enough.
//   shift  of the far background since frame 0
[[nodiscard]] std::vector<cv::Point> places_in(const Clip& clip, int frame, int count, cv::Point shift = {});

}  // namespace sigs::bench
