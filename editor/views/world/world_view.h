// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "editor/views/context.h"
#include "editor/views/world/bodies.h"
#include "editor/views/world/tools.h"
#include "editor/views/world/view_presets.h"

namespace sigs::editor {

// The world from outside: camera path, view frustum, intruders, trajectories, light; waypoints moved with a gizmo.
class WorldView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context);

 private:
  void refresh_model(const ViewContext& context);
  void look_at_opened_project(const WorldContext& world, const ScreenRect& rect);
  void go_with_camera(const WorldContext& world);
  void draw_world(WorldCanvas& canvas, const WorldContext& world);

  WorldViewState look_;
  WorldModel model_;
  BodyShapes shapes_;
  WorldTools tools_;
  std::uint64_t opened_revision_ = 0;   // the first of the project that is looked at
  bool framed_with_scene_ = false;      // it has been framed with all its trajectories known
  std::optional<glm::dvec3> camera_m_;  // where it was in the update before
};

}  // namespace sigs::editor
