// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "ego_motion/features.h"
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

struct RoughControl {
  std::function<void(int done, int total)> progress;  // frames; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
};

// Follows features through up to max_frames frames: all, or stretches of 300 spread evenly over the footage.
// `looked_at` is called with some ten luma images (CV_8UC1) of frames spread over them; it may be empty.
// Errors: those of FrameSource::read, interrupted.
[[nodiscard]] Result<PixelTracks> tracked_pixels(FrameSource& footage, int max_frames,
                                                 const std::function<void(int number, const cv::Mat&)>& looked_at,
                                                 const RoughControl& control);

// A feature in two frames, px.
struct PixelPair {
  Eigen::Vector2d before;
  Eigen::Vector2d after;
};

// The features that both frames have. What keeps still in the image while most of it moves is left out: the own body.
[[nodiscard]] std::vector<PixelPair> common_pixels(const TrackedFrame& before, const TrackedFrame& after);

// Median of how far they have moved, px; 0 where there are none.
[[nodiscard]] double median_motion_px(std::span<const PixelPair> pairs);

}  // namespace sigs
