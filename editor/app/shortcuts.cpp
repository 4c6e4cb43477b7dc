// SPDX-License-Identifier: MIT
#include "editor/app/app.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

// Group, keys, and what they do; in the order of the help page.
constexpr std::array<std::array<const char*, 3>, 38> kShortcuts{{
    {"Playing", "Space, K", "play, stop"},
    {"Playing", "L", "play on; again: faster"},
    {"Playing", "J", "play backwards; again: faster"},
    {"Going", "Left, Right or , .", "one frame"},
    {"Going", "Shift + Left, Right", "ten frames"},
    {"Going", "Home, End", "first, last frame of the range"},
    {"Going", "Up, Down", "previous, next waypoint"},
    {"Cameras", "C, Shift + C", "next, previous camera"},
    {"Cameras", "A", "all side by side; again: one"},
    {"Range", "I, O", "mark in, out here"},
    {"Range", "X", "unmark"},
    {"Waypoints", "Enter or Insert", "add one here"},
    {"Waypoints", "Ctrl + D", "duplicate"},
    {"Waypoints", "Delete", "delete"},
    {"Waypoints", "Esc", "select nothing"},
    {"Project", "Ctrl + Z", "undo"},
    {"Project", "Ctrl + Shift + Z, Ctrl + Y", "redo"},
    {"Project", "Ctrl + N", "new, of a video"},
    {"Project", "Ctrl + O", "open"},
    {"Project", "Ctrl + S", "save"},
    {"Project", "Ctrl + Shift + S", "save as"},
    {"Project", "Ctrl + E", "export"},
    {"Project", "Ctrl + Q", "quit"},
    {"Footage", "wheel; middle drag", "zoom at the cursor; pan"},
    {"Footage", "F or 0; 1", "whole image; pixel for pixel"},
    {"Footage", "Shift or Alt in a drag", "along the line of sight"},
    {"Footage", "Backslash, held", "the footage alone"},
    {"Stages", "click; Esc", "one large; all again"},
    {"Own body", "drag; Shift + drag", "paint; with the other brush"},
    {"Own body", "B, E", "brush, eraser"},
    {"Own body", "[ ]", "smaller, larger brush"},
    {"Own body", "Ctrl + Z, Ctrl + Y", "undo, redo of strokes, after a press there"},
    {"Own body", "Esc in a stroke", "take it back"},
    {"Own body", "wheel; middle drag; F; 1; Backslash", "as over the footage"},
    {"World", "F", "everything in sight"},
    {"World", "N", "type a position"},
    {"Window", "F11", "full screen"},
    {"Window", "?", "this list"},
}};

void go(const ViewContext& context, int frame) {
  context.edits.ask(Play{0});
  context.edits.go_to_frame(frame);
}

void step(const ViewContext& context, int by) {
  go(context, context.document.playhead() + by);
}

// Faster with each press in the same direction, up to eight times.
void shuttle(const ViewContext& context, int direction) {
  const double speed = context.speed * direction > 0 ? std::min(8.0, std::abs(context.speed) * 2) : 1;
  context.edits.ask(Play{direction * speed});
}

void handle_transport_keys(const ViewContext& context) {
  const ImGuiIO& io = ImGui::GetIO();
  const int stride = io.KeyShift ? 10 : 1;
  if (pressed(Key::space) || pressed(Key::k)) context.edits.ask(TogglePlay{});
  if (pressed(Key::l)) shuttle(context, 1);
  if (pressed(Key::j)) shuttle(context, -1);
  if (pressed(Key::right, true) || pressed(Key::period, true)) step(context, stride);
  if (pressed(Key::left, true) || pressed(Key::comma, true)) step(context, -stride);
  if (pressed(Key::home)) go(context, context.document.range_first());
  if (pressed(Key::end)) go(context, context.document.range_last());
}

void handle_camera_keys(const ViewContext& context) {
  const std::size_t count = context.document.cameras().size();
  if (count < 2) return;
  const std::size_t step = ImGui::GetIO().KeyShift ? count - 1 : 1;
  if (pressed(Key::c)) context.edits.activate_camera((context.document.active_camera() + step) % count);
  if (pressed(Key::a)) context.edits.ask(ToggleAllCameras{});
}

void handle_range_keys(const ViewContext& context) {
  const Document& document = context.document;
  if (pressed(Key::i)) context.edits.set_in_out(document.playhead(), document.out());
  if (pressed(Key::o)) context.edits.set_in_out(document.in(), document.playhead());
  if (pressed(Key::x)) context.edits.set_in_out(std::nullopt, std::nullopt);
}

void handle_waypoint_keys(const ViewContext& context) {
  if (pressed(Key::up, true)) go_to_waypoint(context, -1);
  if (pressed(Key::down, true)) go_to_waypoint(context, 1);
  if (enter_pressed() || pressed(Key::insert)) add_waypoint_here(context);
  if (pressed(Key::del) || pressed(Key::backspace)) delete_selected(context);
  if (pressed(Key::escape) && !context.needs.own_escape) context.edits.select({});
}

// With Ctrl held.
void handle_program_keys(const ViewContext& context, bool shift) {
  if (pressed(Key::n)) context.edits.ask(ShowNewProject{});
  if (pressed(Key::o)) context.edits.ask(OpenProject{});
  if (pressed(Key::q)) context.edits.ask(Quit{});
  if (pressed(Key::s)) shift ? context.edits.ask(SaveProjectAs{}) : context.edits.ask(SaveProject{});
}

void handle_edit_keys(const ViewContext& context, bool shift) {
  const bool undoes = !context.needs.own_undo;
  if (undoes && pressed(Key::z, true)) shift ? context.edits.redo() : context.edits.undo();
  if (undoes && pressed(Key::y, true)) context.edits.redo();
  if (pressed(Key::e)) context.edits.ask(ShowExport{});
  if (pressed(Key::d)) duplicate_selected(context);
}

}  // namespace

std::vector<HelpLine> help_lines() {
  std::vector<HelpLine> lines;
  for (const auto& [group, keys, what] : kShortcuts) lines.push_back({group, keys, what});
  return lines;
}

void handle_keys(const ViewContext& context, bool has_project) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId) || io.KeyAlt) return;
  // What the mouse holds may be a waypoint: nothing is changed, opened or saved under it, and Esc is its own.
  const bool mouse_holds = ImGui::IsAnyItemActive();
  if (pressed(Key::f11)) context.edits.ask(ToggleFullScreen{});
  if (pressed(Key::slash) && io.KeyShift) context.edits.ask(ShowHelp{});
  if (io.KeyCtrl && !mouse_holds) handle_program_keys(context, io.KeyShift);
  if (!has_project) return;
  if (io.KeyCtrl) {
    if (!mouse_holds) handle_edit_keys(context, io.KeyShift);
    return;
  }
  handle_transport_keys(context);
  handle_range_keys(context);
  if (mouse_holds) return;
  handle_camera_keys(context);
  handle_waypoint_keys(context);
}

}  // namespace sigs::editor
