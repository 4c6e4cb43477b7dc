// SPDX-License-Identifier: MIT
#include "editor/views/world/world_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "editor/geometry/rulers.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr const char* kId = "world menu";

// The selection was moved to the waypoint when the menu was asked for; what follows acts on it.
bool draw_waypoint_items(const WorldContext& world, const Selection& what) {
  const ViewContext& context = world.context;
  const double frame = frame_of_waypoint(context, what.intruder, what.waypoint);
  if (ImGui::MenuItem(fmt::format("Go to frame {}", std::lround(frame)).c_str())) go_to_moment(context, frame);
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
  if (ImGui::MenuItem(("Go to frame " + text).c_str())) go_to_moment(world.context, whole);
}

void draw_place_items(const WorldContext& world, const std::optional<glm::dvec3>& place_m) {
  const ViewContext& context = world.context;
  if (!current_intruder(context)) {
    if (ImGui::MenuItem("Add an intruder")) add_intruder(context);
    return;
  }
  const std::string frame = std::to_string(context.document.playhead());
  const bool add = context.ui_probe.noted(
      ImGui::MenuItem(("Add a waypoint here at frame " + frame).c_str(), nullptr, false, place_m.has_value()),
      "world/menu/add waypoint");
  if (add) add_waypoint_here(context, place_m);
  if (!place_m) return;
  const double distance_m = glm::distance(*place_m, world.moment.world_from_camera.translation_m);
  ImGui::TextDisabled("%s from the camera, %s high", distance_text(distance_m).c_str(),
                      distance_text(std::max(0.0, -place_m->z)).c_str());
}

constexpr double kClick_px = 4;     // a press that goes no farther is a click
constexpr double kZoomStep = 1.18;  // a notch of the wheel

double snap_now_m(const WorldCanvas& canvas, const WorldViewState& look, const glm::dvec3& at_m) {
  return look.snap != ImGui::GetIO().KeyCtrl ? snap_step_m(canvas.eye(), at_m, canvas.rect()) : 0;
}

std::string coordinates(const glm::dvec3& p_m, double step_m) {
  const int digits = step_m >= 1 ? 0 : step_m >= 0.1 || step_m == 0 ? 1 : 3;
  return fmt::format("X {:.{}f}   Y {:.{}f}   Z {:.{}f}", p_m.x, digits, p_m.y, digits, p_m.z, digits);
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
    case Selected::camera:
      if (!movable(world, what)) {
        ImGui::TextDisabled("%s", kWhyCameraIsFixed);
        return std::nullopt;
      }
      [[fallthrough]];
    case Selected::light:
      if (!movable(world, what)) {
        ImGui::TextDisabled("The inspector has the sun's direction.");
        return std::nullopt;
      }
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

void WorldTools::update(const WorldContext& world, const WorldCanvas& canvas, WorldViewState& look) {
  const bool over = ImGui::IsItemHovered();
  hovered_ = {};
  move_heading(world, canvas, look);
  if (heading_.is_dragging()) return;
  move_handle(world, canvas, look);
  if (handle_.dragging()) return;
  if (over && holding_ == Holding::nothing && handle_.part() == GizmoPart::none)
    hovered_ = pick_at(canvas, world, dv(ImGui::GetMousePos()));
  move_approach(world, canvas, look);
  if (hovered_.what.kind != Selected::nothing) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (over) press(world, canvas);
  hold(canvas.rect(), look);
  release(world, canvas);
  if (!over) return;
  if (ImGui::GetIO().MouseWheel != 0) {
    const double factor = std::pow(kZoomStep, ImGui::GetIO().MouseWheel);
    look.eye = approached(look.eye, factor, dv(ImGui::GetMousePos()), canvas.rect());
    look.touched = true;
  }
  const bool may_type = !ImGui::GetIO().WantTextInput && !ImGui::GetIO().KeyCtrl;
  if (may_type && pressed(Key::n)) enter_position(world, world.context.document.selection());
}

std::optional<Movable> WorldTools::target_of(const WorldContext& world) const {
  return movable(world, handle_.dragging() ? dragged_ : world.context.document.selection());
}

void WorldTools::move_heading(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look) {
  const bool is_free = ImGui::IsItemHovered() && holding_ == Holding::nothing && !handle_.dragging() &&
                       handle_.part() == GizmoPart::none && !approach_.is_dragging();
  heading_.update(world, canvas, is_free, look.snap != ImGui::GetIO().KeyCtrl);
}

void WorldTools::move_approach(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look) {
  const bool is_free = ImGui::IsItemHovered() && holding_ == Holding::nothing && handle_.part() == GizmoPart::none &&
                       hovered_.what.kind != Selected::waypoint && !heading_.has_mouse();
  const double snap_m = snap_now_m(canvas, look, look.eye.target_m);
  approach_.update(world, canvas, is_free, snap_m);
  if (approach_.has_mouse() || heading_.has_mouse()) hovered_ = {};
}

void WorldTools::move_handle(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look) {
  moved_to_.reset();
  if (handle_.dragging() && gesture_.is_lost(world.context)) handle_.abandon_drag();
  const std::optional<Movable> target = target_of(world);
  if (!target) return handle_.abandon_drag();
  const bool was_dragging = handle_.dragging();
  const GizmoInput input{
      .camera = canvas.eye(),
      .rect = canvas.rect(),
      .mouse_is_free = ImGui::IsItemHovered() && holding_ == Holding::nothing && !heading_.has_mouse(),
      .snap_m = snap_now_m(canvas, look, target->at_m)};
  const GizmoResult answer = handle_.update(target->at_m, input);
  if (!was_dragging && handle_.dragging()) begin_drag(world, *target);
  if (answer.moved_to) {
    gesture_.is_moving = true;
    move_to(world, *target, *answer.moved_to);
  }
  moved_to_ = answer.moved_to;
  if (answer.released) world.context.edits.end_gesture();
  if (answer.cancelled) gesture_.cancel(world.context);
  if (answer.wants_numbers || (answer.wants_middle && target->what.kind != Selected::waypoint))
    enter_position(world, target->what);
  else if (answer.wants_middle)  // the first click has selected a waypoint, the second goes to its frame
    go_to_moment(world.context, frame_of_waypoint(world.context, target->what.intruder, target->what.waypoint));
}

void WorldTools::begin_drag(const WorldContext& world, const Movable& moved) {
  dragged_ = moved.what;
  gesture_ = drag_gesture_at(world.context, dv(ImGui::GetMousePos()), gesture_of(dragged_));
}

void WorldTools::press(const WorldContext& world, const WorldCanvas& canvas) {
  const bool left = ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  const bool middle = ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
  const bool right = ImGui::IsMouseClicked(ImGuiMouseButton_Right);
  const bool a_handle_has_it = handle_.part() != GizmoPart::none || approach_.has_mouse() || heading_.has_mouse();
  if (a_handle_has_it && left) return;
  if (holding_ != Holding::nothing || !(left || middle || right)) return;
  held_px_ = 0;
  hovered_ = pick_at(canvas, world, dv(ImGui::GetMousePos()));
  if (left && !ImGui::GetIO().KeyShift) {
    if (const std::optional<Movable> target = movable(world, hovered_.what);
        target && hovered_.what.kind == Selected::waypoint) {
      // Selected by the press, and moved in the screen's plane if the mouse goes on.
      world.context.edits.select(target->what);
      handle_.take(GizmoPart::screen, target->at_m);
      return begin_drag(world, *target);
    }
    holding_ = Holding::orbit;
  } else {
    holding_ = right ? Holding::menu : Holding::pan;
  }
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
  const WorldPick pick = pick_at(canvas, world, dv(ImGui::GetMousePos()));
  if (held == Holding::menu) {
    if (pick.what.kind != Selected::nothing) world.context.edits.select(pick.what);
    menu_.open(pick, place_for_waypoint(canvas, world, dv(ImGui::GetMousePos())));
  } else if (pick.frame) {
    world.context.edits.select({Selected::intruder, pick.what.intruder, 0});
  } else {
    world.context.edits.select(pick.what);
  }
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
  lines.push_back(snap_m > 0 ? fmt::format("steps of {} - Esc puts it back", round_distance_text(snap_m))
                             : std::string("Ctrl for round steps - Esc puts it back"));
  draw_plate(canvas, lines);
}

void WorldTools::keep_handle_free(WorldCanvas& canvas, const WorldContext& world) const {
  const std::optional<Movable> target = target_of(world);
  if (!target) return;
  const glm::dvec3 at_m = moved_to_.value_or(target->at_m);
  for (const ScreenRect& rect : handle_.covered(at_m, {.camera = canvas.eye(), .rect = canvas.rect()}))
    canvas.keep_free(rect);
}

void WorldTools::draw(WorldCanvas& canvas, const WorldContext& world, const WorldViewState& look) {
  const std::optional<Movable> target = target_of(world);
  if (target) {
    const glm::dvec3 at_m = moved_to_.value_or(target->at_m);
    handle_.draw(canvas.list(), at_m, {.camera = canvas.eye(), .rect = canvas.rect()});
    handle_.probe_places(world.context.ui_probe, at_m, {.camera = canvas.eye(), .rect = canvas.rect()});
    if (handle_.dragging() && moved_to_) draw_readout(canvas, *target, snap_now_m(canvas, look, at_m));
  }
  approach_.draw(canvas, world);
  heading_.draw(canvas, world);
  if (const std::vector<std::string> lines = heading_.readout(world); !lines.empty()) draw_plate(canvas, lines);
  if (const std::vector<std::string> lines = approach_.readout(); !lines.empty()) draw_plate(canvas, lines);
  draw_entry(world);
  if (const std::optional<Selection> what = menu_.draw(world)) enter_position(world, *what);
}

}  // namespace sigs::editor
