// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "editor/views/world/menu.h"
#include "editor/views/world/picks.h"
#include "editor/views/world/view_presets.h"
#include "editor/widgets/gizmo_handle.h"
#include "editor/widgets/point_entry.h"

namespace sigs::editor {

// What the mouse does in the world view: looks around, picks, moves what is selected, offers what can be done.
class WorldTools {
 public:
  // Once per update, right after the canvas' item, before anything is drawn; moves the look.
  void update(const WorldContext& world, const WorldCanvas& canvas, WorldViewState& look);
  // Before labels are drawn: none may cover the handle.
  void keep_handle_free(WorldCanvas& canvas, const WorldContext& world) const;
  // After the world: the handle and what is being typed or chosen.
  void draw(WorldCanvas& canvas, const WorldContext& world, const WorldViewState& look);

  [[nodiscard]] const WorldPick& hovered() const { return hovered_; }
  [[nodiscard]] bool moves_camera() const { return handle_.dragging() && dragged_.kind == Selected::camera; }

 private:
  enum class Holding { nothing, orbit, pan, menu };

  void move_handle(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look);
  void cancel_drag(const WorldContext& world);
  void take_waypoint(const WorldContext& world, const Movable& waypoint);
  void press(const WorldContext& world, const WorldCanvas& canvas);
  void hold(const ScreenRect& rect, WorldViewState& look);
  void release(const WorldContext& world, const WorldCanvas& canvas);
  void handle_double_click(const WorldContext& world);
  void enter_position(const WorldContext& world, const Selection& what);
  void draw_entry(const WorldContext& world);
  void draw_readout(WorldCanvas& canvas, const Movable& moved, double snap_m) const;

  GizmoHandle handle_;
  Selection dragged_;                   // what the handle moves
  std::uint64_t revision_before_ = 0;   // of the document, when that began
  std::optional<glm::dvec3> moved_to_;  // in this update
  PointEntry entry_;
  Selection entered_;  // what a position is typed for
  WorldMenu menu_;
  Holding holding_ = Holding::nothing;
  double held_px_ = 0;  // how far the mouse has gone since the press
  WorldPick hovered_;
};

}  // namespace sigs::editor
