// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "calibration/rough_lens.h"
#include "calibration/rough_tracks.h"
#include "ego_motion/settings.h"
#include "telemetry/track.h"

namespace sigs {

// The lens by a gyroscope: how far the image moves for a known turn.
struct GyroAnswer {
  RoughAnswer answer;
  std::string source;   // of the rates in the log: "GPMF GYRO"
  double offset_s = 0;  // time of the log less that of the footage
  double offset_sd_s = 0;
  double correlation = 0;  // of the turns seen and recorded
};

// First the offset and a first focal length by the correlation of turns seen and recorded (ego_motion/time_offset.h);
// then focal length, distortion, offset and the axes of the gyroscope by least squares over single features: a feature
// is followed from one frame to one before it and one after it, and the sum of both misses is made small, from which
// all that moves evenly meanwhile cancels: the aircraft's own travel, the gyroscope's bias. Refused where the log has
// no rates, the turns seen do not follow it (stabilised footage, another flight), or the camera turns too little.
// Once the flag is true it ends within a fraction of a second, and the answer means nothing.
[[nodiscard]] GyroAnswer lens_by_gyro(const PixelTracks& tracks, const Track& log, const DistortionPrior& prior,
                                      CancelFlag cancel = nullptr);

// The lens by a turn of the camera alone. When a camera turns, all that is far away moves as a rotation of its rays
// (Hartley 1997, "Self-calibration of stationary cameras"): what is at the border otherwise than what is in the middle,
// by the square of its angle from the axis. Pairs of frames with the most motion are taken, spread over the footage;
// focal length and distortion, common to all, and a rotation for each pair are fitted to single features.
// The uncertainty is by how much parts of the footage disagree.
// Refused where the camera turns too little, or where rotations explain the motion clearly worse than what is free to
// be any plane's (a homography): a camera that travels past near ground.
[[nodiscard]] RoughAnswer lens_by_turn(const PixelTracks& tracks, const DistortionPrior& prior);

}  // namespace sigs
