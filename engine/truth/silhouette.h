// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "base/image.h"
#include "base/point_tree.h"
#include "base/pose.h"
#include "camera/camera.h"
#include "camera/row_motion.h"

namespace sigs {

// The whole silhouette through the lens.
struct Silhouette {
  Box box;                            // of all points that have an image
  bool all_have_image = true;         // false: some lie behind the camera or beyond the lens' valid field
  std::int64_t lens_evaluations = 0;  // number of points that were sent through the lens
};

// The smallest box around the images of the points. Nothing where no point has an image.
//   points_in_body  the model's vertices, metres
[[nodiscard]] std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                                      const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                      const Lens& lens);

// The same box, but where the body is seen under a small angle, groups of points that cannot widen it are not sent
// through the lens. That is decided by the lens' magnification, measured at the corners of the body's extent: a group
// is left out where its images cannot reach the edge of the box found so far with 1.3 times the largest of them. A body
// near by, near the edge of the lens' field, or where the magnification differs across it by more than a fifth is
// measured by all points.
[[nodiscard]] std::optional<Silhouette> silhouette_by_groups(const PointTree& points_in_body,
                                                             const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                             const Lens& lens);

// As a rolling shutter sees it, by all points.
[[nodiscard]] std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                                      const RowMotion& motion, const Lens& lens);

}  // namespace sigs
