// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "editor/views/world/look.h"
#include "editor/views/world/menu.h"
#include "editor/views/world/picks.h"
#include "editor/widgets/gizmo_handle.h"
#include "editor/widgets/point_entry.h"

namespace sigs::editor {

// What the mouse does in the world view: looks around, picks, moves what is selected, offers what can be done.
class WorldTools {
 public:
  // Once a turn, right after the canvas' item, before anything is drawn; moves the look.
  void update(const WorldTurn& turn, const WorldCanvas& canvas, WorldLook& look);
  // Before labels are drawn: none may cover the handle.
  void keep_handle_free(WorldCanvas& canvas, const WorldTurn& turn) const;
  // After the world: the handle and what is being typed or chosen.
  void draw(WorldCanvas& canvas, const WorldTurn& turn, const WorldLook& look);

  [[nodiscard]] const WorldPick& hovered() const { return hovered_; }
  [[nodiscard]] bool moves_camera() const { return handle_.dragging() && dragged_.kind == Selected::camera; }

 private:
  enum class Holding { nothing, orbit, pan, menu };

  void move_handle(const WorldTurn& turn, const WorldCanvas& canvas, const WorldLook& look);
  void cancel_drag(const WorldTurn& turn);
  void take_waypoint(const WorldTurn& turn, const Movable& waypoint);
  void press(const WorldTurn& turn, const WorldCanvas& canvas);
  void hold(const ScreenRect& rect, WorldLook& look);
  void release(const WorldTurn& turn, const WorldCanvas& canvas);
  void take_double_click(const WorldTurn& turn);
  void enter_position(const WorldTurn& turn, const Selection& what);
  void draw_entry(const WorldTurn& turn);
  void draw_readout(WorldCanvas& canvas, const Movable& moved, double snap_m) const;

  GizmoHandle handle_;
  Selection dragged_;                   // what the handle moves
  std::uint64_t revision_before_ = 0;   // of the document, when that began
  std::optional<glm::dvec3> moved_to_;  // in this turn
  PointEntry entry_;
  Selection entered_;  // what a position is typed for
  WorldMenu menu_;
  Holding holding_ = Holding::nothing;
  double held_px_ = 0;  // how far the mouse has gone since the press
  WorldPick hovered_;
};

}  // namespace sigs::editor
