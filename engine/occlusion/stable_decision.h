// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "occlusion/gradient_sums.h"
#include "occlusion/mean_frame.h"
#include "occlusion/method.h"
#include "occlusion/stable_boundaries.h"
#include "occlusion/stable_motion.h"
#include "project/project.h"

namespace sigs {

// How the method `stable` decides, step by step; images of the means' size.
struct StableDecision {
  Motion motion;
  cv::Mat drift;   // slow_drift.h
  cv::Mat moving;  // the larger of both, CV_32FC1, 0..1
  Boundaries boundaries;
  cv::Mat labels;      // CV_8UC1, 255: may be body, by the first of several cuts
  cv::Mat body;        // CV_8UC1, 255: body
  cv::Mat confidence;  // CV_32FC1: 0 surely world, 0.5 nobody can tell, 1 surely body
  std::optional<std::string> undecided;
};

// settings: lengths in pixels of the means.
[[nodiscard]] StableDecision stable_decision(const GradientMoments& moments, const std::vector<MeanFrame>& segments,
                                             const StableOwnBodySettings& settings);

// The steps for people, CV_8UC1, of the means' size; without the result.
[[nodiscard]] std::vector<DetectionStage> stage_images(const StableDecision& decision);

}  // namespace sigs
