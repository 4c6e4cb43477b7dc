// SPDX-License-Identifier: MIT
#include "editor/preview/first_project_job.h"

#include <algorithm>
#include <utility>

#include "first_project/first_camera.h"
#include "video/frame_source.h"

namespace sigs::editor {

FirstProjectJob::FirstProjectJob(std::function<void()> wake, const Make& make)
    : FirstProjectJob(std::move(wake), make, std::make_shared<Step>()) {}

FirstProjectJob::FirstProjectJob(std::function<void()> wake, const Make& make, const std::shared_ptr<Step>& step)
    : BackgroundJob(std::move(wake),
                    [make, step](const FirstProjectOptions& options, const JobControl& control) {
                      const auto tell = [&](int done, int total, const std::string& text) {
                        {
                          const std::lock_guard lock(step->mutex);
                          step->text = text;
                        }
                        control.progress(done, total);
                      };
                      return make(options, {.progress = tell, .cancel = control.cancel});
                    }),
      step_(step) {}

std::string FirstProjectJob::step() const {
  const std::lock_guard lock(step_->mutex);
  return step_->text;
}

namespace {

// "a pinhole of 69.5 degrees along the diagonal, by what the file states (...)"; "" where it is of no use.
std::string stated_lens(const std::filesystem::path& video, const VideoInfo& info, const LoggedLens& lens) {
  if (!lens.diagonal_fov_rad && !lens.horizontal_fov_rad) return "";
  const Result<FirstCamera> camera = first_camera({.video = video}, info, lens);
  return camera ? camera->note.text.substr(0, camera->note.text.find(';')) : "";
}

}  // namespace

Result<VideoFacts> video_facts(const std::filesystem::path& video, const JobControl& control) {
  const Result<FrameSource> footage = FrameSource::open(video, control.cancel);
  if (!footage) return fail(footage.error());
  const VideoInfo& info = footage->info();
  const double rate_hz = double(info.frame_rate_num) / std::max(1, info.frame_rate_den);
  const double last_s = info.times_s.empty() ? 0 : info.times_s.back();
  const Result<FirstLog> log = log_of_video(video, control.cancel);
  if (!log) return fail(log.error());
  return VideoFacts{.size_px = info.size_px,
                    .frames = info.frame_count(),
                    .duration_s = last_s + (rate_hz > 0 ? 1 / rate_hz : 0),
                    .rate_hz = rate_hz,
                    .lens = log->lens ? stated_lens(video, info, *log->lens) : ""};
}

VideoFactsJob::VideoFactsJob(std::function<void()> wake) : BackgroundJob(std::move(wake), video_facts) {}

}  // namespace sigs::editor
