// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "base/result.h"
#include "camera/lens_table.h"
#include "camera/virtual_camera.h"
#include "frame/intruder_layers.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "scene/scene_at.h"

namespace sigs {

// Where an intruder is, before anything is rendered: its silhouette through the lens and the blur at its distance. The
// lens evaluations are counted.
[[nodiscard]] IntruderLayers placed_layers(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                           const Camera& camera);

// For warped(): where the rays of a row lead. step: size of its pixels in the image's.
[[nodiscard]] TurnOfRow turn_of_row(const IntruderLayers& layers, double step = 1);

// What is to be rendered of an intruder.
struct RenderPlan {
  cv::Rect warp_rect;                 // pixels of the warped layer; may extend beyond the image by the blur's margin
  std::vector<VirtualCamera> views;   // virtual cameras; none where no part of the intruder can be in the image
  std::array<glm::dvec3, 8> corners;  // of the box around the mesh, metres, camera frame
  Light light;                        // camera frame
};

[[nodiscard]] RenderPlan render_plan_for(const IntruderLayers& layers, LensTable& lens, const Scene& scene,
                                         const SceneMoment& moment);

// One image of the intruder for each virtual camera of the plan. Counts the operations, and adds the seconds to
// layers.draw_s.
[[nodiscard]] Result<std::vector<RenderedView>> rendered_views(const std::vector<VirtualCamera>& views,
                                                               const RenderPlan& plan, const Scene& scene,
                                                               IntruderLayers& layers, Renderer& renderer);

// Area of the whole silhouette in pixels. Where it extends beyond the warped layer, a coarse image of all of it is
// rendered through the same lens and summed.
[[nodiscard]] Result<double> whole_area_px(IntruderLayers& layers, const RenderPlan& plan, const LensTable& lens,
                                           const Scene& scene, Renderer& renderer);

}  // namespace sigs
