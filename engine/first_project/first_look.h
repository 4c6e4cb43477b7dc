// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "appearance/surroundings.h"
#include "base/result.h"
#include "first_project/first_project.h"
#include "scene/scene.h"
#include "video/frame_source.h"

namespace sigs {

// What a few frames of the footage show.
struct FirstLook {
  SurroundingsEstimate surroundings;  // light and sun
  std::optional<double> roll_rad;     // of the camera, by the horizon in the images; with pitch_rad or not at all
  std::optional<double> pitch_rad;
};

// Looks at up to 7 frames of the scene's range. Damaged ones are left out. The horizon is sought only where the scene
// does not know it, and is taken where it lies within 4 degrees of the median in at least half of the frames, and is
// tilted by at most 7. Errors: those of FrameSource::read().
[[nodiscard]] Result<FirstLook> first_look(FrameSource& footage, const Scene& scene, const std::atomic<bool>* cancel);

// Sets the project's light by what was seen; one note for light.kind. Where no sky was seen the light stays.
[[nodiscard]] FirstProjectNote set_light(const FirstLook& look, Project& project);

}  // namespace sigs
