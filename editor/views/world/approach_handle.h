// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "editor/geometry/plane_drag.h"
#include "editor/views/encounter/approach_edit.h"
#include "editor/views/world/scene.h"

namespace sigs::editor {

// The handle of the closest approach, a diamond where the current intruder is then. Dragged, it moves the miss sideways
// and in height, perpendicular to the horizontal relative motion: speed, bearing and time stay. One undo step; Escape
// takes it back. A double click goes to its frame.
class ApproachHandle {
 public:
  // Once per update, before anything is picked.
  //   mouse_is_free  over the canvas, nothing else has it or is nearer to it
  //   snap_m         > 0: misses are rounded to multiples of it
  void update(const WorldContext& world, const WorldCanvas& canvas, bool mouse_is_free, double snap_m);
  // The mouse is over it, or drags it: presses are its own.
  [[nodiscard]] bool has_mouse() const { return is_hovered_ || is_dragging(); }
  [[nodiscard]] bool is_dragging() const { return start_.has_value(); }
  // While it is dragged, under the view: the misses, or why there is no such encounter.
  [[nodiscard]] std::vector<std::string> readout() const;
  void draw(WorldCanvas& canvas, const WorldContext& world);

 private:
  // What is drawn, as dragged; none: there is no closest approach.
  [[nodiscard]] std::optional<PresentApproach> shown(const ViewContext& context);
  void press(const ViewContext& context, int intruder);
  void drag(const ViewContext& context, const WorldCanvas& canvas, double snap_m);

  PresentApproachMemory memory_;
  bool is_hovered_ = false;
  // Since the press: what the drag starts from, and in which plane it moves.
  std::optional<ApproachStart> start_;
  PlaneDrag plane_;
  DragGesture gesture_;
  PlannedApproach wish_;  // where the mouse has brought it
  std::string reason_;    // why the last step could not be done
  // The wish of a drag that is over, until the scene shows it.
  std::optional<PresentApproach> left_;
};

}  // namespace sigs::editor
