// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "appearance/appearance.h"
#include "comparison/lit_like.h"
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

// By what in the footage the light is to be found.
struct LightRequest {
  Project project;
  int frame = 0;
  Box box;
};

// The light on what is in the box (comparison/lit_like.h). On the calling thread, for seconds. Errors: those of
// lit_like().
[[nodiscard]] Result<LitLike> found_light(const LightRequest& request, const JobControl& control);

using LightState = JobState<LightRequest, LitLike>;

}  // namespace sigs::editor
