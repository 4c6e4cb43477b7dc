// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <thread>

#include "base/result.h"

namespace sigs::editor {

// A composited frame of a project around one of its intruders, CV_8UC3, of that size: what a card on the start page
// shows. Where intruders cannot be composed, the middle frame of the footage.
[[nodiscard]] Result<cv::Mat> project_thumbnail(const std::filesystem::path& project, cv::Size size_px);

// Such images, made one after the other on a thread of its own when they are first asked for, and kept.
class ProjectThumbnails {
 public:
  // wake  called from that thread when one is ready
  ProjectThumbnails(cv::Size size_px, std::function<void()> wake);
  ~ProjectThumbnails();  // waits for the one at work
  ProjectThumbnails(const ProjectThumbnails&) = delete;
  ProjectThumbnails& operator=(const ProjectThumbnails&) = delete;

  // Null: not there yet, or there is none to be had.
  [[nodiscard]] std::shared_ptr<const cv::Mat> of(const std::filesystem::path& project);

 private:
  void work();

  cv::Size size_px_;
  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable asked_;
  std::deque<std::filesystem::path> queue_;
  std::map<std::filesystem::path, std::shared_ptr<const cv::Mat>> images_;  // null while it is made
  bool stop_ = false;
  std::thread thread_;  // started at the first question
};

}  // namespace sigs::editor
