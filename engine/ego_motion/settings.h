// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "base/threads.h"

namespace sigs {

// A function of this module that takes a CancelFlag (base/threads.h) ends within a fraction of a second once it is
// true, and what it returns then means nothing: who gave the flag has to look at it.

// What a long step of the work takes: the flag, and whom to tell which share of the step is done, 0 to 1, on the
// calling thread.
struct StepControl {
  CancelFlag cancel = nullptr;
  std::function<void(double share)> progress = {};

  [[nodiscard]] bool is_cancelled() const { return sigs::is_cancelled(cancel); }
  void report(double share) const {
    if (progress) progress(share);
  }
};

// What exchanges error for run time, and what is known of the camera. The defaults are those of which bench/ego_motion
// shows that more of anything takes longer and gains little.
struct EgoMotionSettings {
  int features = 240;      // wanted at a time, spread evenly over the image; 20 or more
  int max_width_px = 640;  // features are followed in an image reduced to this width; 64 or more
  int key_every = 8;       // frames between key frames; 2 or more
  int window_keys = 48;    // key frames that are adjusted together, two or more times window_overlap
  int window_overlap = 16;
  int min_features = 12;  // with fewer that agree, a frame's motion is not known; 4 or more

  // Rolling shutter: from the first row to the last, seconds; 0: all rows at once. Not given: that of the telemetry,
  // else 0. Row y of h is exposed at the frame's time + readout_s * (y / (h - 1) - 0.5), so that the time of a frame is
  // that of its middle row.
  std::optional<double> readout_s = {};

  bool use_horizon = true;         // where it is seen, roll and pitch are absolute
  bool fits_focal_length = false;  // where the turns show another one than a pinhole calibration has, it is theirs
  bool use_gyro = true;            // fuse the rates of the telemetry, where there are any

  // Factors from the adjustment's own standard deviation to the one that is reported: sd_factor of all of it, sd_growth
  // of what it grows by while features leave the image and others take over. The errors of a feature in successive
  // frames are not independent, which the adjustment takes them to be. What the adjustment cannot see, since it is
  // common to features that stay in view, grows with the square root of time: sd_walk_px of the reduced image after one
  // second. Fitted to synthetic flights.
  double sd_factor = 1.0;
  double sd_walk_px = 0.035;
  double sd_growth = 4.0;
};

}  // namespace sigs
