// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/rough_fit.h"
#include "calibration/rough_tracks.h"

namespace sigs {

// The lens by a turn of the camera alone. When a camera turns, all that is far away moves as a rotation of its rays
// (Hartley 1997, "Self-calibration of stationary cameras"): what is at the border otherwise than what is in the middle,
// by the square of its angle from the axis. Pairs of frames with the most motion are taken, spread over the footage;
// focal length and distortion, common to all, and a rotation for each pair are fitted to single features.
// The uncertainty is by how much parts of the footage disagree.
// Refused where the camera turns too little, or where rotations explain the motion clearly worse than what is free to
// be any plane's (a homography): a camera that travels past near ground.
[[nodiscard]] RoughAnswer lens_by_turn(const PixelTracks& tracks, const DistortionPrior& prior);

}  // namespace sigs
