// SPDX-License-Identifier: MIT
// What the mouse does in the viewport; the drawing is in viewport_view.cpp.
#include <imgui.h>

#include <cmath>
#include <string>

#include "editor/views/viewport/viewport_view.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

void ViewportView::handle_press(const ImageCanvas& canvas, const ToolContext* tool) {
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  grip_mouse_ = mouse;
  grip_ = Grip::nothing;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
    grip_ = Grip::ground;
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    const bool on_waypoint = tool != nullptr && waypoint_at(*tool) != nullptr;
    if (!on_waypoint && wipe_.is_at(canvas, mouse))
      grip_ = Grip::line;
    else
      grip_ = grip_of_press(tool);
  }
  if (grip_ == Grip::ground) look_.begin_pan();
}

// Waypoints lie over the horizon, which lies over intruders' boxes.
ViewportView::Grip ViewportView::grip_of_press(const ToolContext* tool) {
  if (tool == nullptr) return Grip::ground;
  const bool on_waypoint = waypoint_at(*tool) != nullptr;
  if (overlays_.horizon && !on_waypoint && horizon_.press(*tool)) return Grip::horizon;
  return tool_.press(*tool) ? Grip::waypoint : Grip::ground;
}

void ViewportView::handle_mouse(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool) {
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  const bool down = ImGui::IsMouseDown(ImGuiMouseButton_Left) || ImGui::IsMouseDown(ImGuiMouseButton_Middle);
  const bool on_line = grip_ == Grip::line || (grip_ == Grip::nothing && hovered_ && wipe_.is_at(canvas, mouse));
  if (on_line) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  const bool may_hold = grip_ == Grip::horizon || (grip_ == Grip::nothing && hovered_ && overlays_.horizon);
  if (may_hold && !on_line && tool != nullptr && horizon_.part_at(*tool))
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  if (hovered_ && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) handle_double_click(context, canvas, tool);
  if (tool_.is_active() && tool != nullptr && down) tool_.drag(*tool);
  if (horizon_.is_active() && tool != nullptr && down) horizon_.drag(*tool);
  if (grip_ == Grip::line) wipe_.drag_to(canvas, mouse);
  const bool drags = glm::distance(mouse, grip_mouse_) >= scaled(3) || !look_.is_fitted();
  if (grip_ == Grip::ground && down && drags && mouse != grip_mouse_) look_.pan(mouse - grip_mouse_);
  if (down) return;
  tool_.release(context);
  horizon_.release(context);
  grip_ = Grip::nothing;
}

void ViewportView::handle_double_click(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool) {
  if (grip_ == Grip::line || grip_ == Grip::horizon || (tool != nullptr && waypoint_at(*tool) != nullptr)) return;
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  if (tool == nullptr || !overlays_.waypoints || !current_intruder(context) || !canvas.pixel_at(mouse)) {
    look_.fit();
    return;
  }
  tool_.release(context);
  add_waypoint_at(*tool, canvas.view.image_of(mouse));
}

void ViewportView::draw_waypoint_menu(const ViewContext& context) {
  const WaypointMark& mark = *menu_waypoint_;
  ImGui::TextDisabled("Waypoint %d, frame %.4g", mark.waypoint + 1, mark.frame);
  ImGui::Separator();
  if (ImGui::MenuItem("Go to its frame")) {
    context.edits.ask(Play{0});
    context.edits.go_to_frame(static_cast<int>(std::clamp(std::round(mark.frame), 0.0, 1e9)));
  }
  if (ImGui::MenuItem("Duplicate", "Ctrl+D")) duplicate_selected(context);
  if (ImGui::MenuItem("Delete", "Del")) delete_selected(context);
}

void ViewportView::draw_menu(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool) {
  if (hovered_ && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
    menu_waypoint_.reset();
    menu_intruder_.reset();
    if (tool != nullptr) {
      if (const WaypointMark* mark = waypoint_at(*tool)) {
        menu_waypoint_ = *mark;
        context.edits.select({Selected::waypoint, mark->intruder, mark->waypoint});
      }
      menu_intruder_ = intruder_at(*tool);
    }
    menu_pixel_ = canvas.view.image_of(dv(ImGui::GetMousePos()));
    ImGui::OpenPopup("image menu");
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(6)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(10), scaled(8)});
  if (ImGui::BeginPopup("image menu")) {
    if (menu_waypoint_)
      draw_waypoint_menu(context);
    else
      draw_image_menu(context, tool);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

void ViewportView::draw_image_menu(const ViewContext& context, const ToolContext* tool) {
  const std::vector<IntruderSettings>& intruders = context.project().intruders;
  if (menu_intruder_ && static_cast<std::size_t>(*menu_intruder_) < intruders.size()) {
    const std::string text = "Select " + shortened(intruders[static_cast<std::size_t>(*menu_intruder_)].name, 60);
    if (ImGui::MenuItem(text.c_str())) context.edits.select({Selected::intruder, *menu_intruder_, 0});
    ImGui::Separator();
  }
  const bool can_add = tool != nullptr && current_intruder(context).has_value();
  if (ImGui::MenuItem("Add waypoint here", "double click", false, can_add)) add_waypoint_at(*tool, menu_pixel_);
  if (intruders.empty() && ImGui::MenuItem("Add intruder")) add_intruder(context);
  ImGui::Separator();
  if (ImGui::MenuItem("Wipe against the footage", nullptr, wipe_.is_on())) wipe_.toggle();
  if (ImGui::MenuItem("Fit", "F")) look_.fit();
}

}  // namespace sigs::editor
