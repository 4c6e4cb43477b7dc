// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "appearance/appearance.h"
#include "base/result.h"
#include "project/project.h"
#include "scene/scene.h"
#include "video/frame_source.h"

namespace sigs {

// What a project knows of its camera at each frame, for estimate_appearance(): the calibration, attitude and height
// where they are stated, the own body's mask, the sun's direction where the camera's log has UTC and place. Intruders
// and their models are not looked at, and may be missing. Errors name the project file and the field.
//   height_is_guess  the camera's height in the project was guessed (is_still_guessed() in first_project), and counts
//                    as not known
//   warn             called with each warning of the files that are read
[[nodiscard]] Result<AppearanceHints> hints_of(const Project& project, const VideoInfo& footage, bool height_is_guess,
                                               const std::function<void(const Warning&)>& warn);

// The same by a scene of which no project file is written yet: its camera, its attitude where that is known, and the
// sun by time and place. The height counts as not known: that of a project which is being made is a guess.
[[nodiscard]] AppearanceHints hints_of(const Scene& scene);

}  // namespace sigs
