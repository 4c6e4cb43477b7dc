// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// One step of the detection as an image for people: 8 bit, one channel, of the footage's size.
struct DetectionStage {
  std::string name;   // part of a file name: "difference_sum"
  std::string title;  // "Sum of normalised differences"
  cv::Mat image;
};

enum class KeepStages { no, yes };

// What a method says after the frames it has seen.
struct Verdict {
  cv::Mat own_body;                      // CV_8UC1, 255: own body, 0: world; hard edge
  cv::Mat confidence;                    // CV_32FC1: 0 surely world, 0.5 nobody can tell, 1 surely own body
  std::vector<DetectionStage> stages;    // in order; empty unless asked for
  std::optional<std::string> undecided;  // why nothing can be told ("nothing moves"); the mask is black then
};

// A way to find the own body in a stream of frames. It sees each frame once and keeps sums, never frames: its memory
// does not grow with their number.
class DetectionMethod {
 public:
  DetectionMethod() = default;
  DetectionMethod(const DetectionMethod&) = delete;
  DetectionMethod& operator=(const DetectionMethod&) = delete;
  virtual ~DetectionMethod() = default;

  // The next frame used: its luma, CV_8UC1, all of one size, full range or limited as the footage has it. The samples
  // may be written over after the call.
  virtual void add(const cv::Mat& luma) = 0;

  // The mask as far as it is known. May be asked for at any time, also between frames; needs two frames.
  [[nodiscard]] virtual Verdict verdict(KeepStages keep) const = 0;
};

// paper.h: section 4 of the paper. stable.h: what stays put while the world moves.
[[nodiscard]] std::unique_ptr<DetectionMethod> detection_method(const OwnBodySettings& settings, cv::Size size_px);

}  // namespace sigs
