// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "autocalibration/division_lens.h"
#include "base/result.h"
#include "ego_motion/features.h"
#include "ego_motion/settings.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

// Features that were followed through footage, in pixels: nothing of a lens is known yet.
struct TrackedFrame {
  int number = 0;  // of the frame in the footage
  double time_s = 0;
  std::vector<Feature> features;  // by rising id; the same id in all frames of a stretch is the same feature
  int stretch = 0;                // frames of different stretches have no feature in common
  bool is_repeated = false;       // shows the image of the frame before again
};

struct PixelTracks {
  cv::Size size_px;
  double step_px = 1;  // how many of the footage's pixels one of the reduced image spans, in which they were followed
  std::vector<TrackedFrame> frames;
};

struct AutocalibrationControl {
  std::function<void(int done, int total)> progress;  // frames; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
};

// Follows features through up to max_frames frames: all, or stretches of 300 spread evenly over the footage.
// Errors: those of FrameSource::read, interrupted.
[[nodiscard]] Result<PixelTracks> tracked_pixels(FrameSource& footage, int max_frames,
                                                 const AutocalibrationControl& control);

// A feature in two frames, px.
struct PixelPair {
  glm::dvec2 before;
  glm::dvec2 after;
};

// The features that both frames have. What keeps still in the image while most of it moves is left out: the own body.
[[nodiscard]] std::vector<PixelPair> common_pixels(const TrackedFrame& before, const TrackedFrame& after);

// Median of how far they have moved, px; 0 where there are none.
[[nodiscard]] double median_motion_px(std::span<const PixelPair> pairs);

// The lens by a gyroscope: how far the image moves for a known turn.
struct GyroAnswer {
  LensAnswer answer;
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
[[nodiscard]] LensAnswer lens_by_turn(const PixelTracks& tracks, const DistortionPrior& prior);

}  // namespace sigs
