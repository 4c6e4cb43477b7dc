// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <vector>

#include "appearance/surroundings.h"
#include "base/result.h"
#include "first_project/first_project.h"
#include "scene/scene.h"
#include "video/frame_source.h"

namespace sigs {

// What tells the level in the footage.
enum class LevelBy {
  nothing,
  horizon,  // a straight one, which tells roll and pitch
  skyline,  // sky above woods, hills, houses: tells the pitch to some degrees
  sky,      // nothing but sky: the camera looks up, by an unknown angle
  ground,   // nothing but ground: the camera looks down, by an unknown angle
};

// What a few frames of the footage show.
struct FirstLook {
  SurroundingsEstimate surroundings;  // light and sun
  LevelBy level_by = LevelBy::nothing;
  double roll_rad = 0, pitch_rad = 0;  // of the camera; guessed for `sky` and `ground`, 0 for `nothing`
};

// Looks at up to 7 frames of the scene's range. Damaged ones are left out. The level is sought only where the scene
// does not know it. A horizon (horizon/horizon.h) is taken where it lies within 4 degrees of the median in at least
// half of the frames; else a skyline in at least half of them; else sky, or ground, that fills at least half of them.
// Errors: those of FrameSource::read().
[[nodiscard]] Result<FirstLook> first_look(FrameSource& footage, const Scene& scene, const std::atomic<bool>* cancel);

// Sets the camera's attitude by what was seen; one note for camera.attitude_deg. A camera that looks up by more than 5
// degrees is taken to stand on the ground, where no log has its path.
[[nodiscard]] std::vector<FirstProjectNote> set_attitude(const FirstLook& look, bool has_path, Project& project);

// Sets the project's light by what was seen; one note for light.kind. Where no sky was seen the light stays.
[[nodiscard]] FirstProjectNote set_light(const FirstLook& look, Project& project);

}  // namespace sigs
