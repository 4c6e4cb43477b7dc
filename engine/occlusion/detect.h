// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "base/result.h"
#include "occlusion/method.h"
#include "project/project.h"
#include "video/frame_source.h"

namespace sigs {

// What was found of the aircraft that carries the camera in its own footage.
struct OwnBody {
  cv::Mat mask;        // CV_8UC1 of the footage's size, 255: own body; its edge is as soft as the settings ask
  cv::Mat confidence;  // CV_16UC1: 0 surely world, 32768 undecided, 65535 surely own body
  std::vector<DetectionStage> stages;
  int frames_used = 0;
  int frames_passed = 0;   // of the footage, from the first used to the last
  bool converged = false;  // ended early: more frames no longer changed the mask (convergence.h)
  double last_change = 0;  // where converged: 1 - intersection over union of the masks of the last two checks
  double share = 0;        // of the image that is masked, 0..1
  std::vector<Warning> warnings;
};

// A mask from shorter footage, or one that covers more of the image, should be inspected before it is used.
inline constexpr double kEnoughFootage_s = 10;
inline constexpr double kLargeShare = 0.5;

struct DetectionControl {
  std::function<void(int done, int total)> progress;  // frames passed and to be passed; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
  KeepStages stages = KeepStages::no;
};

// Finds the own body in frames first_frame, first_frame + every, ... of the footage, in one pass. Memory does not grow
// with their number. Damaged frames are left out, with a warning. first_frame must be a frame of the footage. Errors:
// bad_data (fewer than 2 frames, all frames equal, nothing moves, a frame that cannot be decoded or is of another
// size), interrupted.
[[nodiscard]] Result<OwnBody> detect_own_body(FrameSource& footage, int first_frame, const OwnBodySettings& settings,
                                              const DetectionControl& control);

}  // namespace sigs
