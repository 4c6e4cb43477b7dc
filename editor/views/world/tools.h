// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/context.h"
#include "editor/views/world/approach_handle.h"
#include "editor/views/world/picks.h"
#include "editor/views/world/view_presets.h"
#include "editor/widgets/gizmo_handle.h"

namespace sigs::editor {

// The menu of the right button, for what was under the mouse when it was clicked.
class WorldMenu {
 public:
  // place_m: where a new waypoint would be, in the world; nothing where the mouse is beside the plane for waypoints.
  void open(const WorldPick& pick, const std::optional<glm::dvec3>& place_m);
  // Once per update. Returns what the user wants to type a position for, in the update in which that is chosen; what
  // else is chosen goes into the context's edits.
  [[nodiscard]] std::optional<Selection> draw(const WorldContext& world);

 private:
  enum class State { closed, asked, open };

  [[nodiscard]] std::optional<Selection> draw_items(const WorldContext& world) const;

  State state_ = State::closed;
  // What was under the mouse when it was opened.
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

  // What is under the mouse while nothing is held; the views draw it highlighted.
  [[nodiscard]] const WorldPick& hovered() const { return hovered_; }
  // Whether the project's camera is being dragged.
  [[nodiscard]] bool moves_camera() const { return handle_.dragging() && dragged_.kind == Selected::camera; }

 private:
  // What a press beside the handle has become: orbiting or panning the view, or a menu when it is let go.
  enum class Holding { nothing, orbit, pan, menu };

  // The closest approach takes the mouse where no waypoint is nearer.
  void move_approach(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look);
  // Lets the handle of what is selected take the mouse, and moves that point.
  void move_handle(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look);
  void begin_drag(const WorldContext& world, const Movable& moved);
  // A press on a waypoint: selects it and begins a drag in the plane of the screen.
  void take_waypoint(const WorldContext& world, const Movable& waypoint);
  void press(const WorldContext& world, const WorldCanvas& canvas);
  void hold(const ScreenRect& rect, WorldViewState& look);
  void release(const WorldContext& world, const WorldCanvas& canvas);
  // Goes to the frame of the selected waypoint.
  void handle_double_click(const WorldContext& world);
  // Opens the field for typed coordinates, where `what` can be moved.
  void enter_position(const WorldContext& world, const Selection& what);
  void draw_entry(const WorldContext& world);
  void draw_readout(WorldCanvas& canvas, const Movable& moved, double snap_m) const;

  GizmoHandle handle_;
  ApproachHandle approach_;
  // What the handle moves while it is dragged.
  Selection dragged_;
  DragGesture gesture_;
  // Where it was moved to in this update, in the world: the document has it only in the next.
  std::optional<glm::dvec3> moved_to_;
  PointEntry entry_;
  // What a position is typed for.
  Selection entered_;
  WorldMenu menu_;
  Holding holding_ = Holding::nothing;
  // How far the mouse has gone since the press, in screen pixels: a short way is a click.
  double held_px_ = 0;
  WorldPick hovered_;
};

}  // namespace sigs::editor
