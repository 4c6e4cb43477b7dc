// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/context.h"
#include "editor/views/world/picks.h"
#include "editor/views/world/view_presets.h"
#include "editor/widgets/gizmo_handle.h"

namespace sigs::editor {

// The menu of the right button, for what was under the mouse when it was clicked.
class WorldMenu {
 public:
  // place_m: where a new waypoint would be, in the world; nothing where the mouse is beside the plane for waypoints.
  void open(const WorldPick& pick, const std::optional<glm::dvec3>& place_m);
  // Once per update. Returns what the user wants to type a position for, in the update in which that is chosen.
  [[nodiscard]] std::optional<Selection> draw(const WorldContext& world);

 private:
  enum class State { closed, asked, open };

  [[nodiscard]] std::optional<Selection> draw_items(const WorldContext& world) const;

  State state_ = State::closed;
  WorldPick pick_;
  std::optional<glm::dvec3> place_m_;
};

// The mouse in the world view. Drags beside everything orbit or pan the camera of the view, the wheel zooms, a click
// selects, a drag of the selected point's handle moves it in the project (one undo step; Escape takes it back), and the
// right button opens a menu.
class WorldTools {
 public:
  // Once per update, right after the canvas' ImGui item and before anything is drawn. Changes `look` (camera, preset).
  void update(const WorldContext& world, const WorldCanvas& canvas, WorldViewState& look);
  // Before labels are drawn: keeps the handle's area free of them.
  void keep_handle_free(WorldCanvas& canvas, const WorldContext& world) const;
  // After the world: draws the handle, the field for typed coordinates and the menu.
  void draw(WorldCanvas& canvas, const WorldContext& world, const WorldViewState& look);

  [[nodiscard]] const WorldPick& hovered() const { return hovered_; }
  [[nodiscard]] bool moves_camera() const { return handle_.dragging() && dragged_.kind == Selected::camera; }

 private:
  enum class Holding { nothing, orbit, pan, menu };

  void move_handle(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look);
  void begin_drag(const WorldContext& world, const Movable& moved);
  void take_waypoint(const WorldContext& world, const Movable& waypoint);
  void press(const WorldContext& world, const WorldCanvas& canvas);
  void hold(const ScreenRect& rect, WorldViewState& look);
  void release(const WorldContext& world, const WorldCanvas& canvas);
  void handle_double_click(const WorldContext& world);
  void enter_position(const WorldContext& world, const Selection& what);
  void draw_entry(const WorldContext& world);
  void draw_readout(WorldCanvas& canvas, const Movable& moved, double snap_m) const;

  GizmoHandle handle_;
  Selection dragged_;  // what the handle moves
  DragGesture gesture_;
  std::optional<glm::dvec3> moved_to_;  // in this update
  PointEntry entry_;
  Selection entered_;  // what a position is typed for
  WorldMenu menu_;
  Holding holding_ = Holding::nothing;
  double held_px_ = 0;  // how far the mouse has gone since the press
  WorldPick hovered_;
};

}  // namespace sigs::editor
