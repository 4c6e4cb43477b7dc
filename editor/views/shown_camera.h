// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include "editor/geometry/lens_projection.h"
#include "editor/views/context.h"

namespace sigs::editor {

// Where the camera is, for all views. What the project alone decides (place at the start, mounting, speed) is the
// document's, so that it does not lag behind a drag; what files decide (path and attitude of a log, an attitude file)
// is that of the newest scene that is open.

// The camera by the settings alone: straight on along world X, with what carries it level.
[[nodiscard]] CameraPose camera_pose_at(const Project& project, double time_s);

// The camera at a time of the footage.
[[nodiscard]] CameraPose camera_pose_at(const ViewContext& context, double time_s);

// Time of a frame in seconds, by the footage where it is known, else by 25 frames a second.
[[nodiscard]] double time_of(const ViewContext& context, double frame);

// How far the document's camera.position_m has moved the path of the scene's log since that scene was opened; 0 where
// no log moves the camera. World, metres.
[[nodiscard]] glm::dvec3 path_shift_m(const ViewContext& context);

// Whether a file turns the camera: an attitude file, or a log that was read.
[[nodiscard]] bool is_turned_by_file(const ViewContext& context);

// Along which axes of the world camera.position_m moves the camera: all, unless a log gives its place on the Earth.
[[nodiscard]] glm::bvec3 movable_axes(const ViewContext& context);

// Why the camera cannot be moved over the ground, in a sentence.
inline constexpr const char* kWhyCameraIsFixed =
    "The log says where the camera is: it has geodetic positions, and latitude and longitude of the world are stated.";

}  // namespace sigs::editor
