// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "base/image.h"
#include "camera/camera.h"
#include "compositor/bend.h"
#include "render/renderer.h"
#include "scene/scene_at.h"

namespace sigs {

// One intruder, ready to be drawn in any views.
struct Sitter {
  const Mesh& mesh;
  const PlacedIntruder& placed;
  const Light& light;
  std::array<glm::dvec3, 8> corners;  // of the box around it, metres, camera frame
};

[[nodiscard]] std::array<glm::dvec3, 8> corners_in_camera(const Mesh& mesh,
                                                          const Pose<frame::Camera, frame::Body>& camera_from_body);

[[nodiscard]] Result<std::vector<DrawnView>> drawn_views(const std::vector<VirtualView>& views, const Sitter& sitter,
                                                         Renderer& renderer);

// The same lens before cells of step by step pixels: cell (i, j) covers the square [i, i + 1) x [j, j + 1) times step,
// from the upper left corner of the picture.
[[nodiscard]] Camera coarse_camera(const Camera& camera, double step);
[[nodiscard]] Box coarse_box(const Box& box_px, double step);

// Larger than anything that is looked at in pixels or cells.
inline const cv::Rect kEverywhere{-1'000'000, -1'000'000, 2'000'000, 2'000'000};

}  // namespace sigs
