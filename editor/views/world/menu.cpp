// SPDX-License-Identifier: MIT
#include "editor/views/world/menu.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/views/readable.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr const char* kId = "world menu";

void go_to(const ViewContext& context, double frame) {
  context.edits.ask(Play{0});
  context.edits.go_to_frame(static_cast<int>(std::clamp(std::round(frame), 0.0, 1e9)));
}

double frame_of(const ViewContext& context, const Selection& waypoint) {
  return frames_of_waypoints(context, waypoint.intruder)[static_cast<std::size_t>(waypoint.waypoint)];
}

// The selection was moved to the waypoint when the menu was asked for; what follows acts on it.
bool draw_waypoint_items(const WorldContext& world, const Selection& what) {
  const ViewContext& context = world.context;
  const std::string frame = std::to_string(std::lround(frame_of(context, what)));
  if (ImGui::MenuItem(("Go to frame " + frame).c_str())) go_to(context, frame_of(context, what));
  const bool numbers = ImGui::MenuItem("Type its position ...", "N");
  ImGui::Separator();
  if (ImGui::MenuItem("Duplicate", "Ctrl+D")) duplicate_selected(context);
  if (ImGui::MenuItem("Delete", "Del")) delete_selected(context);
  return numbers;
}

void draw_curve_items(const WorldContext& world, int intruder, double frame) {
  const double whole = std::round(frame);
  const std::string text = std::to_string(std::lround(whole));
  if (ImGui::MenuItem(("Insert a waypoint at frame " + text).c_str()))
    if (const std::optional<glm::dvec3> at_m = position_of(world.context, intruder, whole))
      add_waypoint(world.context, intruder, whole, *at_m);
  if (ImGui::MenuItem(("Go to frame " + text).c_str())) go_to(world.context, whole);
}

void draw_place_items(const WorldContext& world, const std::optional<glm::dvec3>& place_m) {
  const ViewContext& context = world.context;
  if (!current_intruder(context)) {
    if (ImGui::MenuItem("Add an intruder")) add_intruder(context);
    return;
  }
  const std::string frame = std::to_string(context.document.playhead());
  const bool add =
      ImGui::MenuItem(("Add a waypoint here at frame " + frame).c_str(), nullptr, false, place_m.has_value());
  context.ui_probe.note_item("world/menu/add waypoint");
  if (add) add_waypoint_here(context, place_m);
  if (!place_m) return;
  const double distance_m = glm::distance(*place_m, world.moment.world_from_camera.translation_m);
  ImGui::TextDisabled("%s from the camera, %s high", distance_text(distance_m).c_str(),
                      distance_text(std::max(0.0, -place_m->z)).c_str());
}

}  // namespace

void WorldMenu::open(const WorldPick& pick, const std::optional<glm::dvec3>& place_m) {
  pick_ = pick;
  place_m_ = place_m;
  state_ = State::asked;
}

std::optional<Selection> WorldMenu::draw_items(const WorldContext& world) const {
  const Selection& what = pick_.what;
  if (pick_.frame) {
    draw_curve_items(world, what.intruder, *pick_.frame);
    return std::nullopt;
  }
  switch (what.kind) {
    case Selected::waypoint:
      if (!movable(world, what)) return std::nullopt;
      return draw_waypoint_items(world, what) ? std::optional(what) : std::nullopt;
    case Selected::light:
    case Selected::camera:
      return ImGui::MenuItem("Type its position ...", "N") ? std::optional(what) : std::nullopt;
    case Selected::intruder:
      if (ImGui::MenuItem("Add a waypoint here", "Enter")) add_waypoint_here(world.context);
      return std::nullopt;
    default:
      draw_place_items(world, place_m_);
      return std::nullopt;
  }
}

std::optional<Selection> WorldMenu::draw(const WorldContext& world) {
  if (state_ == State::closed) return std::nullopt;
  if (state_ == State::asked) {
    ImGui::OpenPopup(kId);
    state_ = State::open;
  }
  if (!ImGui::BeginPopup(kId)) {
    state_ = State::closed;
    return std::nullopt;
  }
  const std::optional<Selection> numbers_for = draw_items(world);
  ImGui::EndPopup();
  return numbers_for;
}

}  // namespace sigs::editor
