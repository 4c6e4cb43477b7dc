// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "project/project.h"

namespace sigs::editor {

// What is done to the cameras of a project. `whole` is the project as its file has it.

// Adds a camera with this video, at the aircraft's origin looking ahead, called after the video's file; its calibration
// is still to be chosen. A project with one camera becomes a rig, whose first camera, "camera 1", is that one: what it
// shows stays the same to the pixel.
void add_camera(Project& whole, const std::filesystem::path& video);

// Takes one out. The first one stays, as waypoints count its frames and the clock is its. Where it alone is left, and
// sits at the aircraft's origin looking ahead, the project has one camera again, with that one's look.
void remove_camera(Project& whole, std::size_t camera);

// Why a camera cannot be called so, in a sentence; "": it can.
[[nodiscard]] std::string why_not_called(const Project& whole, std::size_t camera, const std::string& name);

}  // namespace sigs::editor
