// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "appearance/appearance.h"
#include "base/result.h"
#include "project/project.h"
#include "video/frame_source.h"

namespace sigs::cli {

// What a project knows of its camera at each frame, for `sigs appearance`: the calibration, attitude and height where
// they are stated, the own body's mask. Intruders and their models are not looked at, and may be missing. Warnings are
// printed. Errors name the project file and the field.
[[nodiscard]] Result<AppearanceHints> hints_of(const Project& project, const VideoInfo& footage);

}  // namespace sigs::cli
