// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "ego_motion/ego_motion.h"

namespace sigs {

// Roll, pitch and yaw over time, one below the other, in degrees, each with a band of two standard deviations of the
// rotation since frame 0 (about the camera's axes, which for small rolls are those of the angles). Lost frames are
// grey. BGR, 8 bits. The motion has at least one frame.
[[nodiscard]] cv::Mat attitude_plot(const EgoMotion& motion);

}  // namespace sigs
