// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "evaluation/opencv_tracker.h"
#include "evaluation/results.h"

namespace sigs {

// Several of OpenCV's trackers on one clip, fed the same images in turn. Each says what it would say alone.
class TrackerGroup {
 public:
  // Error usage: there is none of some name, or one is named twice.
  [[nodiscard]] static Result<TrackerGroup> make(const std::vector<std::string>& names);

  // Starts all. Those that cannot are left out, with a remark.
  void start(int frame, const cv::Mat& image, const Box& box);

  // The next image. A tracker that fails says nothing from there on, with a remark.
  void follow(int frame, const cv::Mat& image);

  [[nodiscard]] bool is_started() const { return is_started_; }
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

  // Of those that could be started, in the order of their names.
  [[nodiscard]] std::vector<Results> results() const;

 private:
  struct Member {
    OpenCvTracker tracker;
    bool has_started = false;
    bool has_failed = false;
  };
  std::vector<Member> members_;
  bool is_started_ = false;
  std::vector<std::string> remarks_;
};

}  // namespace sigs
