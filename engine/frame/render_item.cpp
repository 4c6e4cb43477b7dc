// SPDX-License-Identifier: MIT
#include "frame/render_item.h"

#include <utility>

namespace sigs {

std::array<glm::dvec3, 8> corners_in_camera(const Mesh& mesh,
                                            const Pose<frame::Camera, frame::Body>& camera_from_body) {
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) ? mesh.high_m.x : mesh.low_m.x, (i & 2) ? mesh.high_m.y : mesh.low_m.y,
                            (i & 4) ? mesh.high_m.z : mesh.low_m.z);
    corners[i] = camera_from_body * corner;
  }
  return corners;
}

Result<std::vector<RenderedView>> rendered_views(const std::vector<VirtualCamera>& views, const RenderItem& item,
                                                 Renderer& renderer) {
  std::vector<RenderedView> rendered;
  for (const VirtualCamera& view : views) {
    Result<Layer> layer = renderer.draw(item.mesh, item.placed.camera_from_body, item.light, view);
    if (!layer) return fail(layer.error());
    rendered.push_back({view, std::move(*layer)});
  }
  return rendered;
}

Camera coarse_camera(const Camera& camera, double step) {
  LensParameters coarse = camera.lens.parameters();
  coarse.fx /= step;
  coarse.fy /= step;
  coarse.cx = (coarse.cx + 0.5) / step - 0.5;
  coarse.cy = (coarse.cy + 0.5) / step - 0.5;
  return {*Lens::make(coarse), camera.size_px};
}

Box coarse_box(const Box& box_px, double step) {
  return {(box_px.x + 0.5) / step - 0.5, (box_px.y + 0.5) / step - 0.5, box_px.width / step, box_px.height / step};
}

}  // namespace sigs
