// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "project/validate.h"
#include "scene/scene.h"
#include "scene/scene_files.h"

namespace sigs {

// A scene for authoring. What cannot be opened is stood in for and named, so that everything else can be seen and
// edited: a calibration by a pinhole that sees 60 degrees across, an attitude file and an own-body mask by none, a
// model by a cross of its true size (length_m, else 10 m), a trajectory that cannot be flown by hovering at its first
// waypoint.
struct DraftScene {
  Scene scene;
  std::vector<int> intruder_of_project;  // number in scene.intruders of each of the project's; -1: has no waypoint
  std::vector<Problem> problems;         // empty: the scene is what open_scene gives, bit for bit
};

// Never fails. The range is clamped to the footage, which must have at least one frame.
[[nodiscard]] DraftScene draft_scene(const Project& project, const FootageShape& footage, SceneFiles& files);

// The footage of a project whose video cannot be opened: of the size that its calibration states, else 1280x960; 25
// frames a second, as long as the project's last frame or waypoint asks for, at least 250 and at most 100000 frames.
[[nodiscard]] FootageShape placeholder_footage(const Project& project);

}  // namespace sigs
