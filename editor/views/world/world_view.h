// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "editor/views/context.h"
#include "editor/views/world/bodies.h"
#include "editor/views/world/tools.h"
#include "editor/views/world/view_presets.h"

namespace sigs::editor {

// The world from outside: camera path, view frustum, intruders, trajectories, light; waypoints, the light and the
// camera are moved with a handle. It shows the newest scene that is open, with the document's camera.
class WorldView {
 public:
  // Once per update, into what is left of the current ImGui window: toolbar and view. In less than 16 pixels it draws
  // nothing.
  void draw(const ViewContext& context);

 private:
  // Makes the model of another scene.
  void refresh_model(const ViewContext& context);
  // Frames a project that was opened, and once more when its trajectories are known, unless the person has looked
  // around.
  void look_at_opened_project(const WorldContext& world, const ScreenRect& rect);
  // While looking from behind the project's camera, moves with it.
  void go_with_camera(const WorldContext& world);
  void draw_world(WorldCanvas& canvas, const WorldContext& world);

  WorldViewState look_;
  // Of the scene that was open last.
  WorldModel model_;
  BodyShapes shapes_;
  WorldTools tools_;
  // Number of the first revision of the project that is looked at; 0: none.
  std::uint64_t opened_revision_ = 0;
  // It has been framed with all its trajectories known.
  bool framed_with_scene_ = false;
  // Where the project's camera was in the update before, in the world.
  std::optional<glm::dvec3> camera_m_;
};

}  // namespace sigs::editor
