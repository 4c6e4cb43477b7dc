// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "editor/views/timeline/error_lane.h"
#include "editor/views/timeline/lane_groups.h"
#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/offset_drag.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// How far the current intruder is, how large it looks, what hides it and how it flies, frame by frame; above that how
// well trackers follow it, where their results are loaded, and below how the camera turns, where a file turns it: then
// both groups have a header, which is always in sight.
// Pressing or dragging on a lane moves the playhead; with Alt on a lane of the camera it shifts the log in time.
class LaneRows {
 public:
  // Shows the lanes that are shown by default.
  LaneRows();

  // A button at the cursor, with a popup in which lanes are switched on and off.
  void draw_chooser(const ViewContext& context);

  // At the cursor. room_px is how much height there is for all of them, in screen pixels; curves take it between a
  // minimum and a maximum height, so all may be higher than that and scroll. Drags move the playhead by `ruler`.
  void draw(const ViewContext& context, const TimelineStrip& strip, float room_px, RulerRow& ruler);

 private:
  // What is kept of a lane from one update to the next.
  struct LaneState {
    LaneStyle style;
    // As it was ticked or unticked; none: by the style, and "Well clear" only where export.encounter names volumes.
    std::optional<bool> is_chosen = {};
    // Of survey_.
    LaneValues values = {};
  };
  struct Row;

  // Takes the values of another survey; null: none is known.
  void refresh(std::shared_ptr<const Survey> survey);
  [[nodiscard]] bool shows_errors(const ViewContext& context) const;
  // Of one curve, in screen pixels; with room for all lanes that are drawn, folded groups left out.
  [[nodiscard]] float curve_height(float room_px, bool with_errors) const;
  [[nodiscard]] bool is_shown(const LaneState& lane) const;
  // Hidden are those that are not ticked, of a folded group, and of a camera that nothing turns.
  [[nodiscard]] bool is_drawn(const LaneState& lane) const;
  // Those of one group from y downwards.
  void draw_group(const ViewContext& context, const TimelineStrip& strip, LaneGroup group, float y, float curve,
                  RulerRow& ruler);
  [[nodiscard]] float height_of(LaneGroup group, float curve, bool with_errors) const;
  void draw_lane(const ViewContext& context, const Row& row, RulerRow& ruler);
  // The mouse on the lane "Well clear", ImGui's last item; true where a mark has it.
  bool jumps_to_mark(const ViewContext& context, const TimelineStrip& strip);

  std::vector<LaneState> lanes_;  // one for each of lane_styles(), in its order
  bool shows_errors_ = true;      // where there are any
  ErrorLane errors_;
  std::shared_ptr<const Survey> survey_;  // of the current intruder
  LaneGroups groups_;                     // have headers where the camera has lanes
  OffsetDrag offset_;
  bool camera_turns_ = false;   // in this update
  bool names_volumes_ = false;  // export.encounter does, in this update
  bool has_jumped_ = false;     // since the press that is held
};

}  // namespace sigs::editor
