// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "ego_motion/ego_motion.h"
#include "ego_motion/tracks.h"

namespace sigs {

// Found from the frames between which the features move most, by the scale with which rotations alone explain best how
// they move; its limits by drawing those frames anew (bootstrap, Efron 1979), 95 %. Nothing where the camera does not
// turn, where too few features are common, or where what they show is not a rotation: a camera that travels.
//   pixel_rad  angle of one pixel of the image in which the features were followed, by the calibration
[[nodiscard]] std::optional<FocalScale> focal_scale(std::span<const FrameRays> frames, double pixel_rad,
                                                    CancelFlag cancel = nullptr);

}  // namespace sigs
