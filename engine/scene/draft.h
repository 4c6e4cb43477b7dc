// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"
#include "scene/scene_files.h"

namespace sigs {

// A scene for authoring, which exists for every project, however incomplete. What cannot be opened is replaced by a
// placeholder and named in `problems`, so that everything else can be shown and edited:
//   calibration             a pinhole with a horizontal field of view of 60 degrees, principal point in the middle
//   attitude file           a platform that is always level
//   own-body mask           no mask
//   model                   a cross (cross_mesh) of its length: length_m where it is set, else 10 m
//   trajectory              hovering at its first waypoint, where the waypoints make no trajectory
//   first camera's footage  of a rig seen by another camera: placeholder_footage(), whose frames the waypoints count
//   number                  as in sanitized()
struct DraftScene {
  Scene scene;
  std::vector<int> intruder_of_project;  // for each of the project's intruders its index in scene.intruders; -1: it has
                                         // no waypoint and is left out
  std::vector<Problem> problems;         // at most one a field; empty: the scene equals that of open_scene bit for bit
};

// Never fails. The range of frames is clamped to the footage, which must have at least one frame. Validates the project
// by itself: `problems` begin with what validate() finds.
[[nodiscard]] DraftScene draft_scene(const Project& project, const FootageShape& footage, SceneFiles& files);

// The placeholder for footage that cannot be opened: of the size that the project's calibration states, else 1280x960;
// 25 frames a second; as many frames as the project's last frame or waypoint asks for, at least 250, at most 100000.
[[nodiscard]] FootageShape placeholder_footage(const Project& project);

// The project with each number that is not finite replaced by its default (an optional one by none), and each number
// outside its field's range by the nearer end of the range. The order of the waypoints' times is not touched. A project
// without problems is returned unchanged.
[[nodiscard]] Project sanitized(Project project);

}  // namespace sigs
