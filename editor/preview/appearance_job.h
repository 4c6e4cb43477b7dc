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
// open_footage() and of estimate_appearance().
[[nodiscard]] Result<Appearance> estimated_appearance(const AppearanceRequest& request, const JobControl& control);

// The same in the background (editor/views/estimate_session.h).
using AppearanceState = JobState<AppearanceRequest, Appearance>;

}  // namespace sigs::editor
