// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "editor/geometry/image_drag.h"

namespace sigs::editor {

using PixelLine = std::vector<glm::dvec2>;

// A path of the world as a camera that stands still sees it: lines in image pixels, broken where the path has no
// image (behind the camera, beyond the lens' valid field) or one more than 1e5 pixels away. Corners lie so close that
// the line is within half a pixel of the path's image, where that is in or near the image.
//   position_m  metres, world, by time
//   times_s     increasing, two or more: the path's ends and where it may have corners (its waypoints)
[[nodiscard]] std::vector<PixelLine> path_through_lens(const std::function<glm::dvec3(double time_s)>& position_m,
                                                       std::span<const double> times_s,
                                                       const CameraPose& world_from_camera, const Lens& lens,
                                                       const glm::dvec2& image_size);

// The same for straight lines from point to point.
[[nodiscard]] std::vector<PixelLine> points_through_lens(std::span<const glm::dvec3> points_m,
                                                         const CameraPose& world_from_camera, const Lens& lens,
                                                         const glm::dvec2& image_size);

// Where level directions (world z = 0) are seen: the horizon of a flat earth.
[[nodiscard]] std::vector<PixelLine> horizon_through_lens(const CameraPose& world_from_camera, const Lens& lens,
                                                          const glm::dvec2& image_size);

}  // namespace sigs::editor
