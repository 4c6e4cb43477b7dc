// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>

#include "editor/views/timeline/error_lane.h"
#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// How far the current intruder is, how large it looks, what hides it and how it flies, frame by frame; above that how
// well trackers follow it, where their results are loaded. Pressing or dragging on a lane moves the playhead.
class LaneRows {
 public:
  // A button for choosing lanes, at the cursor.
  void draw_chooser(const ViewContext& context);

  // At the cursor; room_px is how much height there is for all of them, which they take if they can use it.
  void draw(const ViewContext& context, const TimelineStrip& strip, float room_px, RulerRow& ruler);

 private:
  struct Row;

  void refresh(std::shared_ptr<const Survey> survey);
  [[nodiscard]] bool shows_errors(const ViewContext& context) const;
  [[nodiscard]] float curve_height(float room_px, bool with_errors) const;
  void draw_lane(const ViewContext& context, const Row& row, RulerRow& ruler) const;

  std::array<bool, kLanes> shown_{true, true, true, true, false, false};
  bool shows_errors_ = true;  // where there are any
  ErrorLane errors_;
  std::shared_ptr<const Survey> survey_;     // of the current intruder
  std::array<LaneValues, kLanes> values_{};  // of that survey
};

}  // namespace sigs::editor
