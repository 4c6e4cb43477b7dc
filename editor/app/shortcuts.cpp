// SPDX-License-Identifier: MIT
#include "editor/app/shortcuts.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "editor/views/waypoint_actions.h"
#include "editor/widgets/keys.h"

namespace sigs::editor {

namespace {

constexpr std::array<Shortcut, 36> kShortcuts{{
    {"Playing", "Space, K", "play, stop"},
    {"Playing", "L", "play on; again: faster"},
    {"Playing", "J", "play backwards; again: faster"},
    {"Going", "Left, Right or , .", "one frame"},
    {"Going", "Shift + Left, Right", "ten frames"},
    {"Going", "Home, End", "first, last frame of the range"},
    {"Going", "Up, Down", "previous, next waypoint"},
    {"Range", "I, O", "mark in, out here"},
    {"Range", "X", "unmark"},
    {"Waypoints", "Enter or Insert", "add one here"},
    {"Waypoints", "Ctrl + D", "duplicate"},
    {"Waypoints", "Delete", "delete"},
    {"Waypoints", "Esc", "select nothing"},
    {"Project", "Ctrl + Z", "undo"},
    {"Project", "Ctrl + Shift + Z, Ctrl + Y", "redo"},
    {"Project", "Ctrl + N", "new"},
    {"Project", "Ctrl + O", "open"},
    {"Project", "Ctrl + S", "save"},
    {"Project", "Ctrl + Shift + S", "save as"},
    {"Project", "Ctrl + E", "export"},
    {"Project", "Ctrl + Q", "quit"},
    {"Footage", "wheel; middle drag", "zoom at the cursor; pan"},
    {"Footage", "F or 0; 1", "whole picture; pixel for pixel"},
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

void step(const Studio& studio, int by) {
  studio.edits.ask(Play{0});
  studio.edits.go_to_frame(studio.document.playhead() + by);
}

void go(const Studio& studio, int frame) {
  studio.edits.ask(Play{0});
  studio.edits.go_to_frame(frame);
}

// Faster with each press in the same direction, up to eight times.
void shuttle(const Studio& studio, int direction) {
  const double speed = studio.speed * direction > 0 ? std::min(8.0, std::abs(studio.speed) * 2) : 1;
  studio.edits.ask(Play{direction * speed});
}

void take_transport_keys(const Studio& studio) {
  const ImGuiIO& io = ImGui::GetIO();
  const int stride = io.KeyShift ? 10 : 1;
  if (pressed(Key::space) || pressed(Key::k)) studio.edits.ask(TogglePlay{});
  if (pressed(Key::l)) shuttle(studio, 1);
  if (pressed(Key::j)) shuttle(studio, -1);
  if (pressed(Key::right, true) || pressed(Key::period, true)) step(studio, stride);
  if (pressed(Key::left, true) || pressed(Key::comma, true)) step(studio, -stride);
  if (pressed(Key::home)) go(studio, studio.document.range_first());
  if (pressed(Key::end)) go(studio, studio.document.range_last());
}

void take_range_keys(const Studio& studio) {
  const Document& document = studio.document;
  if (pressed(Key::i)) studio.edits.set_in_out(document.playhead(), document.out());
  if (pressed(Key::o)) studio.edits.set_in_out(document.in(), document.playhead());
  if (pressed(Key::x)) studio.edits.set_in_out(std::nullopt, std::nullopt);
}

void take_waypoint_keys(const Studio& studio) {
  if (pressed(Key::up, true)) go_to_waypoint(studio, -1);
  if (pressed(Key::down, true)) go_to_waypoint(studio, 1);
  if (pressed(Key::enter) || pressed(Key::keypad_enter) || pressed(Key::insert)) add_waypoint_here(studio);
  if (pressed(Key::del) || pressed(Key::backspace)) delete_selected(studio);
  if (pressed(Key::escape) && !studio.wishes.own_escape) studio.edits.select({});
}

// With Ctrl held.
void take_program_keys(const Studio& studio, bool shift) {
  if (pressed(Key::n)) studio.edits.ask(NewProject{});
  if (pressed(Key::o)) studio.edits.ask(OpenProject{});
  if (pressed(Key::q)) studio.edits.ask(Quit{});
  if (pressed(Key::s)) shift ? studio.edits.ask(SaveProjectAs{}) : studio.edits.ask(SaveProject{});
}

void take_edit_keys(const Studio& studio, bool shift) {
  const bool undoes = !studio.wishes.own_undo;
  if (undoes && pressed(Key::z, true)) shift ? studio.edits.redo() : studio.edits.undo();
  if (undoes && pressed(Key::y, true)) studio.edits.redo();
  if (pressed(Key::e)) studio.edits.ask(ShowExport{});
  if (pressed(Key::d)) duplicate_selected(studio);
}

}  // namespace

std::span<const Shortcut> shortcuts() {
  return kShortcuts;
}

void take_keys(const Studio& studio, bool has_project) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId) || io.KeyAlt) return;
  // What the mouse holds may be a waypoint: nothing is changed, opened or saved under it, and Esc is its own.
  const bool mouse_holds = ImGui::IsAnyItemActive();
  if (pressed(Key::f11)) studio.edits.ask(ToggleFullScreen{});
  if (pressed(Key::slash) && io.KeyShift) studio.edits.ask(ShowHelp{});
  if (io.KeyCtrl && !mouse_holds) take_program_keys(studio, io.KeyShift);
  if (!has_project) return;
  if (io.KeyCtrl) {
    if (!mouse_holds) take_edit_keys(studio, io.KeyShift);
    return;
  }
  take_transport_keys(studio);
  take_range_keys(studio);
  if (!mouse_holds) take_waypoint_keys(studio);
}

}  // namespace sigs::editor
