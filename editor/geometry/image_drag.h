// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "base/pose.h"
#include "camera/lens.h"

namespace sigs::editor {

// Moving points of the world over the footage, through its lens.
using CameraPose = Pose<frame::World, frame::Camera>;

// Pixel of a point of the world; nothing where it has no image.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const glm::dvec3& p_in_world, const CameraPose& world_from_camera,
                                                 const Lens& lens);

// The point at a distance from the camera behind a pixel; nothing where no ray meets the pixel.
[[nodiscard]] std::optional<glm::dvec3> point_behind(const glm::dvec2& pixel, double distance_m,
                                                     const CameraPose& world_from_camera, const Lens& lens);

// Dragged from one pixel to another at constant distance. The point keeps its offset from the pixel it was taken at.
// Nothing where a pixel has no ray.
[[nodiscard]] std::optional<glm::dvec3> dragged_across(const glm::dvec3& start_m, const glm::dvec2& from_px,
                                                       const glm::dvec2& to_px, const CameraPose& world_from_camera,
                                                       const Lens& lens);

// Dragged along its ray: up is farther, down is nearer, 100 screen pixels double or halve the distance (0.1 m..1e8 m).
[[nodiscard]] glm::dvec3 dragged_along(const glm::dvec3& start_m, double up_px, const CameraPose& world_from_camera);

}  // namespace sigs::editor
