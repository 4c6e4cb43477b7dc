// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "ego_motion/attitudes.h"

namespace sigs {

// Clouds that drift as one, and nothing else in view, look like an even turn of the camera: at 1 km in a wind of 10 m/s
// of 0.01 rad/s. An image without any parallax may be of that kind, or of ground below a camera that hovers. But what
// looks no more than it turns evenly cannot drift more than that, unless the camera turned against it at the same rate.

// Standard deviation, rad, of the rotation since frame 0 by that drift: it grows in each run of linked frames without
// ground, by the mean rate that is seen from the run's start to its end, 0.01 rad/s at most, and stays elsewhere.
//   times_s  of the frames, rising; as many as rotations
[[nodiscard]] std::vector<double> drift_deviations(std::span<const FrameRotation> rotations,
                                                   std::span<const double> times_s);

}  // namespace sigs
