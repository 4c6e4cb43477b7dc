// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "base/image.h"
#include "camera/camera.h"
#include "compositor/warp.h"
#include "render/renderer.h"
#include "scene/scene_at.h"

namespace sigs {

// One intruder, ready to be rendered in any views.
struct RenderItem {
  const Mesh& mesh;
  const PlacedIntruder& placed;
  const Light& light;
  std::array<glm::dvec3, 8> corners;  // of the box around it, metres, camera frame
};

[[nodiscard]] std::array<glm::dvec3, 8> corners_in_camera(const Mesh& mesh,
                                                          const Pose<frame::Camera, frame::Body>& camera_from_body);

[[nodiscard]] Result<std::vector<RenderedView>> rendered_views(const std::vector<VirtualCamera>& views,
                                                               const RenderItem& item, Renderer& renderer);

// The same lens with coarse pixels of step by step pixels: coarse pixel (i, j) covers the square [i, i + 1) x [j, j +
// 1) times step, from the upper left corner of the image.
[[nodiscard]] Camera coarse_camera(const Camera& camera, double step);
[[nodiscard]] Box coarse_box(const Box& box_px, double step);

// Larger than anything that is measured in pixels or coarse pixels.
inline const cv::Rect kEverywhere{-1'000'000, -1'000'000, 2'000'000, 2'000'000};

}  // namespace sigs
