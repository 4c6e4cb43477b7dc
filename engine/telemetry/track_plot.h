// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "telemetry/track.h"

namespace sigs {

// Drawings of a track over time, one below the other, of what it has: roll, pitch and yaw of the airframe and of the
// camera in degrees, angular rates in degrees per second, height or depth, and the ground track from above in metres
// (north up, both axes to the same scale). Where there are more samples than pixels, each column of pixels shows the
// least and the greatest of them. BGR, 8 bits, 1200 pixels wide. Empty: there is nothing of these in the track.
[[nodiscard]] cv::Mat track_plot(const Track& track);

}  // namespace sigs
