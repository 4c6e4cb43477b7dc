// SPDX-License-Identifier: MIT
#pragma once

#include "autocalibration/lens_by_motion.h"
#include "camera/camera.h"
#include "telemetry/track.h"

namespace sigs::test {

// How a camera turns over points whose directions are known.
struct MadeTurns {
  unsigned seed = 1;
  int frames = 240;
  double rate_hz = 30;
  double pan_rad = 0.5;      // amplitude of slow yaw; a third of it in pitch and roll
  double shake_rad = 0.004;  // amplitude of waves of 3 to 8 Hz about each axis
  double noise_px = 0.3;     // of a feature in one frame, in each direction
  double stray_share = 0.1;  // of features that move on their own
  double speed_mps = 0;      // forward; points lie 30 to 300 m away then, else at infinity
  double gyro_noise_radps = 0.005;
  double gyro_offset_s = 0.04;  // stamp of the log less time of the footage
  double gyro_scale = 1;        // recorded over true
};

struct MadeTracks {
  PixelTracks tracks;
  Track log;  // its rates about the camera's axes, 200 Hz
};

// What a tracker would see of it through the lens: closed forms, no images. Same settings, same numbers.
[[nodiscard]] MadeTracks made_tracks(const Camera& camera, const MadeTurns& settings);

// A lens of OpenCV's models with the principal point in the middle.
[[nodiscard]] Camera made_camera(cv::Size size_px, LensModel model, double focal_px, double k1);

// Angle between the middles of the image's left and right border.
[[nodiscard]] double field_rad(const Camera& camera);

}  // namespace sigs::test
