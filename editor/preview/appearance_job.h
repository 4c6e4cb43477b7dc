// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "appearance/appearance.h"
#include "editor/preview/background_job.h"
#include "project/project.h"

namespace sigs::editor {

// Whose footage is looked at: the frames that the project uses.
struct AppearanceRequest {
  Project project;
};

// Estimates how the footage looks (appearance/appearance.h). On the calling thread, for seconds. Errors: those of
// FrameSource::open() and of estimate_appearance().
[[nodiscard]] Result<Appearance> estimated_appearance(const AppearanceRequest& request, const JobControl& control);

// The same in the background.
using AppearanceState = JobState<AppearanceRequest, Appearance>;
class AppearanceJob : public BackgroundJob<AppearanceRequest, Appearance> {
 public:
  // work: tests give one that reads no video.
  explicit AppearanceJob(std::function<void()> wake, Work work = estimated_appearance)
      : BackgroundJob(std::move(wake), std::move(work)) {}
};

}  // namespace sigs::editor
