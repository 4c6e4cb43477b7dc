// SPDX-License-Identifier: MIT
#include "editor/views/world/tools.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "editor/geometry/ground_grid.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/keys.h"

namespace sigs::editor {

namespace {

constexpr double kClick_px = 4;     // a press that goes no farther is a click
constexpr double kZoomStep = 1.18;  // a notch of the wheel

glm::dvec2 mouse_now() {
  return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
}

double snap_now_m(const WorldCanvas& canvas, const WorldViewState& look, const glm::dvec3& at_m) {
  return look.snap != ImGui::GetIO().KeyCtrl ? snap_step_m(canvas.eye(), at_m, canvas.rect()) : 0;
}

std::string coordinates(const glm::dvec3& p_m, double step_m) {
  const int digits = step_m >= 1 ? 0 : step_m >= 0.1 || step_m == 0 ? 1 : 3;
  char text[160];
  std::snprintf(text, sizeof text, "X %.*f   Y %.*f   Z %.*f", digits, p_m.x, digits, p_m.y, digits, p_m.z);
  return text;
}

void draw_plate(WorldCanvas& canvas, const std::vector<std::string>& lines) {
  ImFont* face = font(Font::small);
  double width = 0;
  for (const std::string& line : lines)
    width = std::max<double>(width, face->CalcTextSizeA(face->FontSize, 1e6F, 0, line.c_str()).x);
  const double line_px = face->FontSize * 1.25;
  const double pad = scaled(8);
  const glm::dvec2 size{width + 2 * pad, line_px * static_cast<double>(lines.size()) + pad};
  const ScreenRect& rect = canvas.rect();
  const glm::dvec2 low{std::round((rect.low.x + rect.high.x - size.x) / 2),
                       std::round(rect.high.y - size.y - scaled(8))};
  canvas.list().AddRectFilled(im(low), im(low + size), IM_COL32(24, 26, 31, 225), scaled(5));
  for (std::size_t i = 0; i < lines.size(); ++i)
    canvas.list().AddText(face, face->FontSize, im(low + glm::dvec2(pad, pad / 2 + line_px * static_cast<double>(i))),
                          i == 0 ? color::kText : color::kQuiet, lines[i].c_str());
}

}  // namespace

void WorldTools::update(const WorldContext& world, const WorldCanvas& canvas, WorldViewState& look) {
  const bool over = ImGui::IsItemHovered();
  hovered_ = {};
  move_handle(world, canvas, look);
  if (handle_.dragging()) return;
  if (over && holding_ == Holding::nothing && handle_.part() == GizmoPart::none)
    hovered_ = pick_at(canvas, world, mouse_now());
  if (hovered_.what.kind != Selected::nothing) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (over) press(world, canvas);
  hold(canvas.rect(), look);
  release(world, canvas);
  if (!over) return;
  if (ImGui::GetIO().MouseWheel != 0) {
    const double factor = std::pow(kZoomStep, ImGui::GetIO().MouseWheel);
    look.eye = approached(look.eye, factor, mouse_now(), canvas.rect());
    look.touched = true;
  }
  const bool may_type = !ImGui::GetIO().WantTextInput && !ImGui::GetIO().KeyCtrl;
  if (may_type && pressed(Key::n)) enter_position(world, world.context.document.selection());
}

void WorldTools::move_handle(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look) {
  moved_to_.reset();
  // Numbers count what they counted as long as nothing but this drag has changed the project.
  if (handle_.dragging() && world.context.document.has_other_changes(revision_before_, gesture_of(dragged_)))
    handle_.abandon_drag();
  const std::optional<Movable> target = handle_.dragging() ? movable(world, dragged_) : movable(world);
  if (!target) {
    handle_.abandon_drag();
    return;
  }
  const bool was_dragging = handle_.dragging();
  const GizmoInput input{.camera = canvas.eye(),
                         .rect = canvas.rect(),
                         .mouse_is_free = ImGui::IsItemHovered() && holding_ == Holding::nothing,
                         .snap_m = snap_now_m(canvas, look, target->at_m)};
  const GizmoResult answer = handle_.update(target->at_m, input);
  if (!was_dragging && handle_.dragging()) {
    dragged_ = target->what;
    revision_before_ = world.context.document.revision().number;
  }
  if (answer.moved_to) move_to(world, *target, *answer.moved_to);
  moved_to_ = answer.moved_to;
  if (answer.released) world.context.edits.end_gesture();
  if (answer.cancelled) cancel_drag(world);
  if (answer.wants_numbers || (answer.wants_middle && target->what.kind != Selected::waypoint))
    enter_position(world, target->what);
  else if (answer.wants_middle)
    handle_double_click(world);
}

void WorldTools::cancel_drag(const WorldContext& world) {
  world.context.edits.cancel_gesture(gesture_of(dragged_));
}

void WorldTools::press(const WorldContext& world, const WorldCanvas& canvas) {
  const bool left = ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  const bool middle = ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
  const bool right = ImGui::IsMouseClicked(ImGuiMouseButton_Right);
  if (handle_.part() != GizmoPart::none && left) return;  // the handle has had it
  if (holding_ != Holding::nothing || !(left || middle || right)) return;
  held_px_ = 0;
  hovered_ = pick_at(canvas, world, mouse_now());
  if (left && !ImGui::GetIO().KeyShift) {
    if (const std::optional<Movable> target = movable(world, hovered_.what);
        target && hovered_.what.kind == Selected::waypoint) {
      take_waypoint(world, *target);
      return;
    }
    holding_ = Holding::orbit;
  } else {
    holding_ = right ? Holding::menu : Holding::pan;
  }
}

// Selected by the press, and moved in the screen's plane if the mouse goes on.
void WorldTools::take_waypoint(const WorldContext& world, const Movable& waypoint) {
  world.context.edits.select(waypoint.what);
  handle_.take(GizmoPart::screen, waypoint.at_m);
  dragged_ = waypoint.what;
  revision_before_ = world.context.document.revision().number;
}

void WorldTools::hold(const ScreenRect& rect, WorldViewState& look) {
  if (holding_ == Holding::nothing) return;
  const glm::dvec2 by_px{ImGui::GetIO().MouseDelta.x, ImGui::GetIO().MouseDelta.y};
  const bool was_click = held_px_ < scaled(kClick_px);
  held_px_ += glm::length(by_px);
  if (holding_ == Holding::menu || held_px_ < scaled(kClick_px)) return;
  const glm::dvec2 move_px = was_click ? glm::dvec2(0) : by_px;  // no jump when the click becomes a drag
  look.touched = true;
  if (holding_ == Holding::pan) look.eye = panned(look.eye, move_px, rect);
  if (holding_ != Holding::orbit || move_px == glm::dvec2(0)) return;
  look.eye = orbited(look.eye, move_px);
  if (look.preset == WorldViewPreset::top || look.preset == WorldViewPreset::side) look.preset = WorldViewPreset::orbit;
}

void WorldTools::release(const WorldContext& world, const WorldCanvas& canvas) {
  const ImGuiMouseButton button = holding_ == Holding::menu ? ImGuiMouseButton_Right : ImGuiMouseButton_Left;
  const bool down =
      ImGui::IsMouseDown(button) || (holding_ == Holding::pan && ImGui::IsMouseDown(ImGuiMouseButton_Middle));
  if (holding_ == Holding::nothing || down) return;
  const Holding held = std::exchange(holding_, Holding::nothing);
  if (held_px_ >= scaled(kClick_px) || held == Holding::pan) return;
  const WorldPick pick = pick_at(canvas, world, mouse_now());
  if (held == Holding::menu) {
    if (pick.what.kind != Selected::nothing) world.context.edits.select(pick.what);
    menu_.open(pick, place_for_waypoint(canvas, world, mouse_now()));
  } else if (pick.frame) {
    world.context.edits.select({Selected::intruder, pick.what.intruder, 0});
  } else {
    world.context.edits.select(pick.what);
  }
}

// The first click has selected a waypoint, the second goes to its frame.
void WorldTools::handle_double_click(const WorldContext& world) {
  const Selection& selection = world.context.document.selection();
  if (selection.kind != Selected::waypoint) return;
  const double frame =
      frames_of_waypoints(world.context, selection.intruder)[static_cast<std::size_t>(selection.waypoint)];
  world.context.edits.ask(Play{0});
  world.context.edits.go_to_frame(static_cast<int>(std::clamp(std::round(frame), 0.0, 1e9)));
}

void WorldTools::enter_position(const WorldContext& world, const Selection& what) {
  const std::optional<Movable> target = movable(world, what);
  if (!target) return;
  entered_ = what;
  entry_.open(target->title, target->at_m);
}

void WorldTools::draw_entry(const WorldContext& world) {
  const std::optional<glm::dvec3> typed_m = entry_.draw();
  if (!typed_m) return;
  const std::optional<Movable> target = movable(world, entered_);
  if (!target) return;
  world.context.edits.end_gesture();  // a step of its own
  move_to(world, *target, *typed_m);
  world.context.edits.end_gesture();
}

void WorldTools::draw_readout(WorldCanvas& canvas, const Movable& moved, double snap_m) const {
  const glm::dvec3 at_m = moved_to_.value_or(moved.at_m);
  std::vector<std::string> lines{coordinates(at_m, snap_m) + "   m",
                                 "moved  " + coordinates(at_m - handle_.start_m(), snap_m)};
  lines.push_back(snap_m > 0 ? "steps of " + round_distance_text(snap_m) + " - Esc puts it back"
                             : std::string("Ctrl for round steps - Esc puts it back"));
  draw_plate(canvas, lines);
}

void WorldTools::keep_handle_free(WorldCanvas& canvas, const WorldContext& world) const {
  const std::optional<Movable> target = handle_.dragging() ? movable(world, dragged_) : movable(world);
  if (!target) return;
  const glm::dvec3 at_m = moved_to_.value_or(target->at_m);
  for (const ScreenRect& rect : handle_.covered(at_m, {.camera = canvas.eye(), .rect = canvas.rect()}))
    canvas.keep_free(rect);
}

void WorldTools::draw(WorldCanvas& canvas, const WorldContext& world, const WorldViewState& look) {
  const std::optional<Movable> target = handle_.dragging() ? movable(world, dragged_) : movable(world);
  if (target) {
    const glm::dvec3 at_m = moved_to_.value_or(target->at_m);
    handle_.draw(canvas.list(), at_m, {.camera = canvas.eye(), .rect = canvas.rect()});
    handle_.probe_places(world.context.ui_probe, at_m, {.camera = canvas.eye(), .rect = canvas.rect()});
    if (handle_.dragging() && moved_to_) draw_readout(canvas, *target, snap_now_m(canvas, look, at_m));
  }
  draw_entry(world);
  if (const std::optional<Selection> what = menu_.draw(world)) enter_position(world, *what);
}

}  // namespace sigs::editor
