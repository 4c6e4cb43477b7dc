// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "base/point_tree.h"
#include "truth/measure.h"

namespace sigs {

// What a search found, and how often it asked the lens, for a point's pixel or for the image of a ball.
struct QuickSilhouette {
  std::optional<Silhouette> silhouette;
  std::int64_t lens_evaluations = 0;
};

// The same as silhouette_of, to the last bit, without asking the lens for every point: branch and bound. Boxes of
// points are passed over where no point of theirs can lie outside what was found (Lens::ball_image); only those that a
// bound says nothing of, because they are wide or lie across the edge of the lens' field, are looked into point by
// point.
//   tree  of the points, tree_of(points_in_body)
[[nodiscard]] QuickSilhouette silhouette_of(std::span<const glm::vec3> points_in_body, const PointTree& tree,
                                            const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens);

}  // namespace sigs
