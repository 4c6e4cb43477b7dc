// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/pose.h"
#include "base/result.h"
#include "project/project.h"

namespace sigs {

// A rig is an aircraft with several cameras (Project::cameras): one flight, one encounter, one truth. What the engine
// works with has one camera: seen_by() gives the project as each of them sees it.

// The project with the footage, mount, clock, readout, exposure and look of one of its cameras in place of those of a
// project with one. Its name is NAME.CAMERA. `cameras` is empty in it, and rig_view says where it comes from.
//   camera  index in project.cameras
[[nodiscard]] Project seen_by(const Project& project, std::size_t camera);

// The reverse, after `seen` was changed: what a camera of a rig has of its own goes back to that camera, all else is the
// rig's. A look that was changed is from then on the camera's own. Without a rig_view `seen` itself.
[[nodiscard]] Project put_back(const Project& whole, Project seen);

// All cameras of a project as projects with one: of a rig seen_by() each; else the project itself.
[[nodiscard]] std::vector<Project> seen_by_each(const Project& project);

// The index of a camera. Errors of the kind usage: the project has no such camera; those that it has are named.
[[nodiscard]] Result<std::size_t> camera_named(const Project& project, const std::string& name);

// Where a field of a project with one camera stands in its file: what seen_by() has taken from a camera of a rig stands
// with that camera. "footage.video" -> "cameras[1].footage.video".
[[nodiscard]] std::string field_in_file(const Project& project, const std::string& field);

// Camera in the axes of the aircraft.
[[nodiscard]] Pose<frame::Body, frame::Camera> body_from_camera(const MountSettings& mount);

}  // namespace sigs
