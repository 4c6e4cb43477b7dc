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

// An intermediate result of the detection as an image for inspection: 8 bit, one channel, of the footage's size.
struct DetectionStage {
  std::string name;   // part of a file name: "difference_sum"
  std::string title;  // "Sum of normalised differences"
  cv::Mat image;
};

// Whether a verdict carries its stages.
enum class KeepStages { no, yes };

// The result of a method after the frames added so far. Images are of the footage's size.
struct Verdict {
  cv::Mat own_body;                      // CV_8UC1, 255: own body, 0: world; hard edge
  cv::Mat confidence;                    // CV_32FC1: 0 surely world, 0.5 undecided, 1 surely own body
  std::vector<DetectionStage> stages;    // in order; empty unless asked for
  std::optional<std::string> undecided;  // why nothing can be decided ("nothing moves"); the mask is black then
};

// A method that finds the own body in a sequence of frames. It processes each frame once and keeps sums, not frames:
// its memory does not grow with their number.
class DetectionMethod {
 public:
  DetectionMethod() = default;
  DetectionMethod(const DetectionMethod&) = delete;
  DetectionMethod& operator=(const DetectionMethod&) = delete;
  virtual ~DetectionMethod() = default;

  // Adds a frame: its luma, CV_8UC1 of the size given to the method, full or limited range as in the footage. The
  // samples may be overwritten after the call.
  virtual void add(const cv::Mat& luma) = 0;

  // The result by the frames added so far, at least two. May be asked for at any time and does not change the method.
  [[nodiscard]] virtual Verdict verdict(KeepStages keep) const = 0;
};

// The method that the settings name. size_px: of the footage.
[[nodiscard]] std::unique_ptr<DetectionMethod> detection_method(const OwnBodySettings& settings, cv::Size size_px);

// The body is what stays in place while the world moves (README.md). vibration_px is in pixels of the footage.
[[nodiscard]] std::unique_ptr<DetectionMethod> stable_method(const StableOwnBodySettings& settings, cv::Size size_px);

// Section 4 of the paper as published: README.md says where it works; its steps are in paper.h. The confidence is the
// signed distance from the mask's border, scaled by how far the steps move that border; it does not say whether the
// method is right on this footage. Undecided where no frame differs from the one before.
[[nodiscard]] std::unique_ptr<DetectionMethod> paper_method(const PaperOwnBodySettings& settings, cv::Size size_px);

}  // namespace sigs
