// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"
#include "project/project.h"

namespace sigs {

// Sets one field as --set gives it: "camera.speed_mps=30", "light.position_m=[0,0,-500]", "export.video.codec=h264".
// The value is JSON; what is no JSON is taken as text. Paths are then relative to the project file, like those in it.
// Errors, kind usage: no "=", no such key (one that is near is named), a value of the wrong type.
[[nodiscard]] Result<void> set_field(Project& project, const std::string& assignment);

}  // namespace sigs
