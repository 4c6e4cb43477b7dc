// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "camera/camera.h"
#include "video/frame_source.h"

namespace sigs {

struct ParallaxSettings {
  int frame = 0;                  // of which the mask is made, counted from 0
  int span = 30;                  // frames before and after it that are compared with it
  double min_parallax_px = 2;     // what moves by this much against infinity within `span` frames is near
  std::optional<double> max_m{};  // or what is nearer than this, where the camera's path is known; instead
};

// What stands near the camera, found by its parallax.
struct NearScenery {
  cv::Mat mask;                    // CV_8UC1 of the footage's size, 255: near
  cv::Mat parallax_px;             // CV_32FC1: motion against infinity within `span` frames; NaN where nothing shows it
  double known_share = 0;          // of the image that has enough texture to tell, 0..1
  double largest_parallax_px = 0;  // in 95 % of that texture it is smaller
  std::vector<Warning> warnings;
};

// The camera's pose at a frame. Positions are used only where max_m is set.
using CameraPoseAt = std::function<Pose<frame::World, frame::Camera>(int frame)>;

struct ParallaxControl {
  std::function<void(int done, int total)> progress;  // frames compared; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
};

// Compares one frame with others around it. Each is turned to its attitude (so that what is infinitely far stands
// still), dense flow (Kroeger et al. 2016) gives what is left, texture and a check back and forth tell where it can be
// trusted, and a cut by colour (Rother et al. 2004) draws the border through what has no texture.
// Errors: bad_data (no other frame; no texture; the camera does not travel: no parallax anywhere), interrupted.
[[nodiscard]] Result<NearScenery> near_scenery(FrameSource& footage, const Camera& camera, const CameraPoseAt& pose_at,
                                               const ParallaxSettings& settings, const ParallaxControl& control = {});

}  // namespace sigs
