// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <string_view>

#include "base/image.h"
#include "base/result.h"
#include "evaluation/results.h"

namespace sigs {

// The trackers that OpenCV has and that need no files: csrt kcf mil mosse medianflow tld boosting.
[[nodiscard]] std::span<const std::string_view> tracker_names();

// One of OpenCV's trackers on one clip: started once, then fed each image in order. Results, images and seeds being
// equal, so is what it says: what it draws at random depends on the image's number alone, not on other trackers that
// are fed in turn.
class OpenCvTracker {
 public:
  // Error usage: there is none of that name; names those there are.
  [[nodiscard]] static Result<OpenCvTracker> make(std::string_view name);
  OpenCvTracker(OpenCvTracker&&) noexcept;
  OpenCvTracker& operator=(OpenCvTracker&&) noexcept;
  ~OpenCvTracker();

  // image is CV_8UC3, BGR. The box is given to OpenCV in whole pixels, as far as it lies in the image; it is also
  // what the tracker is taken to say of this frame. What OpenCV throws is error bad_data.
  [[nodiscard]] Result<void> start(int frame, const cv::Mat& image, const Box& box);

  // Call it after start() went well. A tracker that says that it has lost its target, or gives a box without area or
  // with edges that are not finite, reports nothing in that frame.
  [[nodiscard]] Result<void> follow(int frame, const cv::Mat& image);

  // What it said so far, and frames a second of OpenCV's own time in follow().
  [[nodiscard]] const Results& results() const;

 private:
  struct Impl;
  explicit OpenCvTracker(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sigs
