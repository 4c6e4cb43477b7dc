// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "evaluation/readers/results.h"

namespace sigs {

// OpenCV's trackers, run on the images of a clip to give Results as if read from a file.

// The names of those trackers of OpenCV that need no model files: csrt kcf mil mosse medianflow tld boosting.
[[nodiscard]] std::span<const std::string_view> tracker_names();

// One of OpenCV's trackers on one clip: it is started once and then given each image in order. The same images and box
// give the same results: random numbers depend on the frame number alone, not on other trackers run in turn or on other
// threads.
class OpenCvTracker {
 public:
  // name: one of tracker_names(). Error usage: there is no tracker of this name.
  [[nodiscard]] static Result<OpenCvTracker> make(std::string_view name);

  // A tracker can be moved, not copied.
  OpenCvTracker(OpenCvTracker&&) noexcept;
  OpenCvTracker& operator=(OpenCvTracker&&) noexcept;
  ~OpenCvTracker();

  // Starts it on a frame (the footage's number) with the target's box, which is rounded to whole pixels and clipped to
  // the image (CV_8UC3, BGR). That box is also its result in this frame. Error bad_data: the box lies outside the image
  // or is too small for the tracker, or OpenCV throws.
  [[nodiscard]] Result<void> start(int frame, const cv::Mat& image, const Box& box);

  // Follows the target in the next frame, after start() has succeeded. A tracker that declares its target lost, or
  // returns a box without area or with edges that are not finite, has no result in that frame. Error bad_data: OpenCV
  // throws.
  [[nodiscard]] Result<void> follow(int frame, const cv::Mat& image);

  // The boxes so far, and the frames per second of OpenCV's own time in follow().
  [[nodiscard]] const Results& results() const;

 private:
  struct Impl;
  explicit OpenCvTracker(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Several of OpenCV's trackers on one clip, given the same images in turn. Each has the results that it has alone.
class TrackerGroup {
 public:
  // Error usage: there is no tracker of one of the names, or a name is given twice.
  [[nodiscard]] static Result<TrackerGroup> make(const std::vector<std::string>& names);

  // Starts all trackers. One that cannot start is left out, with a remark.
  void start(int frame, const cv::Mat& image, const Box& box);

  // Gives the next image to all. A tracker that fails has no results from there on, with a remark.
  void follow(int frame, const cv::Mat& image);

  // Whether start() has been called.
  [[nodiscard]] bool is_started() const { return is_started_; }
  // Sentences for the report about trackers that could not start or failed.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

  // The results of the trackers that have started, in the order in which they were named.
  [[nodiscard]] std::vector<Results> results() const;

 private:
  // A tracker that has not started, or has failed, gets no more images.
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
