// SPDX-License-Identifier: MIT
#include "editor/views/timeline/keys.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "editor/document/waypoint_edits.h"
#include "editor/views/timeline/key_marks.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

// What is worked out once for the row that is drawn.
struct KeyRows::Row {
  const TimelineStrip& strip;
  int intruder = 0;
  std::vector<double> frames;  // of its waypoints
  float top_y = 0;
  int under = -1;  // the waypoint below the mouse
};

namespace {

int rounded_frame(double frame) {
  return static_cast<int>(std::lround(std::clamp(frame, 0.0, 1e9)));
}

void select(const ViewContext& context, int intruder, int waypoint) {
  const Selected kind = waypoint < 0 ? Selected::intruder : Selected::waypoint;
  context.edits.select({kind, intruder, std::max(0, waypoint)});
}

void set_frame(const ViewContext& context, int intruder, int waypoint, double frame, const std::string& gesture) {
  context.edits.change(
      "move waypoint in time",
      [=, frames = frames_of_waypoints(context, intruder)](Project& project) {
        TrajectoryPlan& plan = project.intruders[static_cast<std::size_t>(intruder)].trajectory;
        move_waypoint_in_time(plan, waypoint, frame, frames);
      },
      gesture);
}

void add_on_curve(const ViewContext& context, int intruder, double frame) {
  if (const std::optional<glm::dvec3> position_m = position_of(context, intruder, frame)) {
    add_waypoint(context, intruder, frame, *position_m);
    go_by_hand(context, rounded_frame(frame));
  } else {
    context.edits.ask(ShowMessage{"The trajectory is not known yet; try again in a moment.", true});
  }
}

std::string gesture_of(int intruder, int waypoint) {
  return "time " + std::to_string(intruder) + " " + std::to_string(waypoint);
}

// Whole frames; with Alt any moment.
double snapped(double frame) {
  return ImGui::GetIO().KeyAlt ? frame : std::round(frame);
}

const IntruderSettings& settings_of(const ViewContext& context, int intruder) {
  return context.project().intruders[static_cast<std::size_t>(intruder)];
}

void draw_name(const ViewContext& context, const TimelineStrip& strip, int intruder, float top_y, bool current) {
  const float height = KeyRows::row_height();
  ImGui::SetCursorScreenPos({strip.names_x, top_y});
  if (ImGui::InvisibleButton("name", {strip.names_width, height})) select(context, intruder, -1);
  const std::string& name = settings_of(context, intruder).name;
  const std::string shown = elided(name.empty() ? "(no name)" : name, strip.names_width - height - scaled(4));
  if (shown != name) tooltip_for_item(name.c_str());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered())
    list.AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), IM_COL32(255, 255, 255, 12), scaled(3));
  const float middle_y = top_y + height / 2;
  draw_icon(list, Icon::aircraft, {strip.names_x + height / 2, middle_y}, height * 0.72F, intruder_color(intruder));
  list.AddText({strip.names_x + height + scaled(2), std::floor(middle_y - ImGui::GetFontSize() / 2)},
               current ? color::kText : color::kQuiet, shown.c_str());
}

// The key nearest to the mouse within reach; of keys on one another the selected one, to be dragged off.
int key_under_mouse(const TimelineStrip& strip, const std::vector<double>& frames, int selected) {
  const float mouse_x = ImGui::GetIO().MousePos.x;
  float nearest = scaled(8);
  int found = -1;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const float away = std::abs(strip.moment_x(frames[static_cast<std::size_t>(i)]) - mouse_x);
    if (away < nearest || (i == selected && away <= nearest)) {
      nearest = away;
      found = i;
    }
  }
  return found;
}

}  // namespace

float KeyRows::row_height() {
  return std::ceil(ImGui::GetFontSize() + scaled(6));
}

void KeyRows::probe_places(const ViewContext& context, const Row& row) {
  if (!context.ui_probe.wanted()) return;
  const std::string name = "timeline/row/" + std::to_string(row.intruder);
  context.ui_probe.note_item(name);
  const double reach = scaled(5);
  for (std::size_t i = 0; i < row.frames.size(); ++i) {
    const glm::dvec2 center{row.strip.moment_x(row.frames[i]), row.top_y + row_height() / 2};
    context.ui_probe.note(name + "/key/" + std::to_string(i), {center - reach, center + reach});
  }
}

void KeyRows::drag(const ViewContext& context, const Row& row) {
  Held& held = *held_;
  if (held.waypoint >= static_cast<int>(row.frames.size())) return;
  if (!held.moving && !ImGui::IsMouseDragging(ImGuiMouseButton_Left, scaled(3))) return;
  held.moving = true;
  const double now = row.frames[static_cast<std::size_t>(held.waypoint)];
  go_by_hand(context, rounded_frame(now));  // one update behind, but where its neighbours let it go
  const double wanted = snapped(row.strip.moment_at(ImGui::GetIO().MousePos.x) + held.offset);
  if (wanted == now) return;
  set_frame(context, held.intruder, held.waypoint, wanted, gesture_of(held.intruder, held.waypoint));
}

// Numbers count what they counted as long as nothing but this drag has changed the project.
void KeyRows::hold(const ViewContext& context, const Row& row) {
  const std::string gesture = gesture_of(held_->intruder, held_->waypoint);
  const bool is_cancelled = pressed(Key::escape);
  if (is_cancelled && held_->moving) {
    context.edits.cancel_gesture(gesture);
    go_by_hand(context, rounded_frame(held_->frame_before));
  }
  if (is_cancelled || context.document.has_other_changes(held_->revision_before, held_->moving ? gesture : ""))
    held_.reset();
  else
    drag(context, row);
}

void KeyRows::open_menu(const ViewContext& context, const Row& row, int under) {
  const double at = std::round(row.strip.moment_at(ImGui::GetIO().MousePos.x));
  const double frame = under < 0 ? at : row.frames[static_cast<std::size_t>(under)];
  menu_ = {.intruder = row.intruder, .waypoint = under, .frame = frame, .typed = frame};
  select(context, row.intruder, under);
  menu_asked_ = true;
}

void KeyRows::handle_mouse(const ViewContext& context, const Row& row) {
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) open_menu(context, row, row.under);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && row.under < 0)
    add_on_curve(context, row.intruder, snapped(row.strip.moment_at(ImGui::GetIO().MousePos.x)));
  else if (ImGui::IsItemActivated()) {
    select(context, row.intruder, row.under);
    if (row.under >= 0) {
      const double frame = row.frames[static_cast<std::size_t>(row.under)];
      go_by_hand(context, rounded_frame(frame));
      held_ = Held{.intruder = row.intruder,
                   .waypoint = row.under,
                   .offset = frame - row.strip.moment_at(ImGui::GetIO().MousePos.x),
                   .frame_before = frame,
                   .revision_before = context.document.revision().number};
    }
  }
  if (ImGui::IsItemActive() && held_ && held_->intruder == row.intruder) hold(context, row);
  if (ImGui::IsItemDeactivated() && held_) {
    hold(context, row);
    if (held_ && held_->moving) context.edits.end_gesture();
    held_.reset();
  }
}

void KeyRows::draw_key_menu(const ViewContext& context) {
  ImGui::TextDisabled("waypoint %d, frame %.6g", menu_.waypoint + 1, menu_.frame);
  ImGui::Separator();
  if (ImGui::MenuItem("Go to")) go_by_hand(context, rounded_frame(menu_.frame));
  if (ImGui::MenuItem("Duplicate", "Ctrl+D")) duplicate_selected(context);
  if (ImGui::MenuItem("Delete", "Del")) delete_selected(context);
  if (!ImGui::BeginMenu("Set frame...")) return;
  ImGui::SetNextItemWidth(scaled(110));
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputDouble("##frame", &menu_.typed, 0, 0, "%.6g", ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if ((ImGui::Button("Set") || entered) && std::isfinite(menu_.typed)) {
    set_frame(context, menu_.intruder, menu_.waypoint, menu_.typed, {});
    go_by_hand(context, rounded_frame(menu_.typed));
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndMenu();
}

void KeyRows::draw_menu(const ViewContext& context) {
  if (std::exchange(menu_asked_, false)) ImGui::OpenPopup("key menu");
  if (!ImGui::BeginPopup("key menu")) return;
  const bool there = menu_.intruder < static_cast<int>(context.project().intruders.size());
  if (!there)
    ImGui::CloseCurrentPopup();
  else if (menu_.waypoint >= 0)
    draw_key_menu(context);
  else {
    ImGui::TextDisabled("%s, frame %.6g", elided(settings_of(context, menu_.intruder).name, scaled(200)).c_str(),
                        menu_.frame);
    ImGui::Separator();
    if (ImGui::MenuItem("Add waypoint")) add_on_curve(context, menu_.intruder, menu_.frame);
    if (ImGui::MenuItem("Go there")) go_by_hand(context, rounded_frame(menu_.frame));
    ImGui::Separator();
    if (ImGui::MenuItem("Duplicate intruder")) duplicate_selected(context);
    if (ImGui::MenuItem("Delete intruder")) delete_selected(context);
  }
  ImGui::EndPopup();
}

void KeyRows::draw_row(const ViewContext& context, const TimelineStrip& strip, int intruder) {
  const bool current = current_intruder(context) == intruder;
  const Selection& selection = context.document.selection();
  const int selected = selection.kind == Selected::waypoint && selection.intruder == intruder ? selection.waypoint : -1;
  const ImVec2 low{strip.left(), ImGui::GetCursorScreenPos().y};
  const ImVec2 high{strip.right(), low.y + row_height()};
  draw_name(context, strip, intruder, low.y, current);
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("keys", {std::max(1.0F, high.x - low.x), row_height()});

  Row row{.strip = strip, .intruder = intruder, .frames = frames_of_waypoints(context, intruder), .top_y = low.y};
  if (ImGui::IsItemHovered()) row.under = key_under_mouse(strip, row.frames, selected);
  probe_places(context, row);
  handle_mouse(context, row);
  const int held = held_ && held_->intruder == intruder ? held_->waypoint : -1;
  const int hot = held >= 0 ? held : row.under;
  const KeyMarks marks{.context = context,
                       .strip = strip,
                       .intruder = intruder,
                       .frames = row.frames,
                       .top_y = low.y,
                       .height = row_height(),
                       .selected = selected,
                       .hot = hot,
                       .current = current};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(low, high, true);
  draw_key_marks(list, marks);
  list.PopClipRect();
  if (!held_ && ImGui::IsItemHovered()) tooltip_for_keys(marks, strip.moment_at(ImGui::GetIO().MousePos.x));
}

void KeyRows::draw(const ViewContext& context, const TimelineStrip& strip) {
  const float x = ImGui::GetCursorScreenPos().x;
  float y = ImGui::GetCursorScreenPos().y;
  const auto count = static_cast<int>(context.project().intruders.size());
  for (int intruder = 0; intruder < count; ++intruder) {
    ImGui::PushID(intruder);
    ImGui::SetCursorScreenPos({x, y});
    // A held key's row stays alive when it is scrolled out of sight.
    const bool held = held_ && held_->intruder == intruder;
    if (held || ImGui::IsRectVisible({1, row_height()})) draw_row(context, strip, intruder);
    ImGui::PopID();
    y += row_height();
    draw_row_line(*ImGui::GetWindowDrawList(), strip, y - 1);
  }
  ImGui::SetCursorScreenPos({x, y});
  draw_menu(context);
}

}  // namespace sigs::editor
