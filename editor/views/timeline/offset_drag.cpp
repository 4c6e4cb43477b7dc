// SPDX-License-Identifier: MIT
#include "editor/views/timeline/offset_drag.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "editor/document/field_edits.h"
#include "editor/views/shown_camera.h"
#include "editor/widgets/screen_vec.h"

namespace sigs::editor {

namespace {

constexpr const char* kKey = "camera.track.offset_s";

glm::dvec2 mouse() {
  return {ImGui::GetMousePos().x, ImGui::GetMousePos().y};
}

}  // namespace

bool OffsetDrag::update_on_item(const ViewContext& context, const TimelineStrip& strip) {
  const unsigned int item = ImGui::GetID("lane");
  if (held_ && held_->item != item) return false;
  const bool may_begin = !context.project().camera.track.file.empty() && ImGui::GetIO().KeyAlt;
  if (!held_ && may_begin && ImGui::IsItemActivated())
    held_ = Held{.item = item,
                 .offset_before_s = context.project().camera.track.offset_s,
                 .gesture = drag_gesture_at(context, mouse(), fmt::format("log offset {}", ++gestures_))};
  if (held_ || (may_begin && ImGui::IsItemHovered())) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (!held_) return false;
  if (!ImGui::IsItemActive()) {
    if (!held_->is_over) held_->gesture.end(context);
    held_.reset();
  } else if (!held_->is_over) {
    drag(context, strip);
  }
  return true;
}

// The curve goes with the mouse: what was at the press is at the mouse's moment, so the log's time there is earlier.
void OffsetDrag::drag(const ViewContext& context, const TimelineStrip& strip) {
  DragGesture& gesture = held_->gesture;
  if (gesture.is_lost(context) || gesture.cancelled_by_key(context)) {
    held_->is_over = true;
    return;
  }
  gesture.is_moving = gesture.is_moving || gesture.has_left_press(mouse());
  if (!gesture.is_moving) return;
  const double by_s =
      time_of(context, strip.moment_at(mouse().x)) - time_of(context, strip.moment_at(gesture.pressed.x));
  const double offset_s = std::round((held_->offset_before_s - by_s) * 1000) / 1000;
  context.edits.change(
      "shift log in time", [offset_s](Project& project) { put_value(project, kKey, offset_s); }, gesture.name);
}

}  // namespace sigs::editor
