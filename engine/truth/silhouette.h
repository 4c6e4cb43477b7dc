// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "base/image.h"
#include "base/pose.h"
#include "camera/camera.h"
#include "camera/row_motion.h"

namespace sigs {

// The whole silhouette through the lens.
struct Silhouette {
  Box box;                     // of all points that have an image
  bool all_have_image = true;  // false: some lie behind the camera or beyond the lens' valid field
};

// The smallest box around the images of the points. Nothing where no point has an image.
//   points_in_body  the model's vertices, metres
[[nodiscard]] std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                                      const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                      const Lens& lens);

// As a rolling shutter sees it.
[[nodiscard]] std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                                      const RowMotion& motion, const Lens& lens);

}  // namespace sigs
