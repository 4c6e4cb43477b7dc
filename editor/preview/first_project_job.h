// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <opencv2/core/types.hpp>
#include <string>

#include "editor/preview/background_job.h"
#include "first_project/first_project.h"

namespace sigs::editor {

// Makes a project of a video in the background, as `sigs init` does. Nothing is written where it fails or is cancelled.
using FirstProjectState = JobState<FirstProjectOptions, FirstProject>;
class FirstProjectJob : public BackgroundJob<FirstProjectOptions, FirstProject> {
 public:
  // What does the work; tests give one that reads no video.
  using Make = std::function<Result<FirstProject>(const FirstProjectOptions&, const FirstProjectControl&)>;

  explicit FirstProjectJob(std::function<void()> wake, const Make& make = make_first_project);

  // What is being done, in words: "reading the video".
  [[nodiscard]] std::string step() const;

 private:
  // Shared with the work, on whose thread it is written.
  struct Step {
    std::mutex mutex;
    std::string text;
  };
  FirstProjectJob(std::function<void()> wake, const Make& make, const std::shared_ptr<Step>& step);

  std::shared_ptr<Step> step_;
};

// What a video tells of itself.
struct VideoFacts {
  cv::Size size_px;
  int frames = 0;
  double duration_s = 0;
  double rate_hz = 0;
  // How its file states the lens; "": it does not.
  std::string lens;
};

// Reads the index of a video, and what its file or its flight log says of the lens. Errors: those of
// FrameSource::open(); interrupted.
[[nodiscard]] Result<VideoFacts> video_facts(const std::filesystem::path& video, const JobControl& control);

// The same in the background.
using VideoFactsState = JobState<std::filesystem::path, VideoFacts>;
class VideoFactsJob : public BackgroundJob<std::filesystem::path, VideoFacts> {
 public:
  explicit VideoFactsJob(std::function<void()> wake);
};

}  // namespace sigs::editor
