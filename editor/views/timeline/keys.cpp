// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "editor/document/project_edits.h"
#include "editor/views/timeline/lanes.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

// What a row of keys shows.
struct KeyMarks {
  const ViewContext& context;
  const TimelineStrip& strip;
  int intruder = 0;
  const std::vector<double>& frames;  // of the waypoints
  float top_y = 0;
  float height = 0;
  int selected = -1;     // waypoint
  int hot = -1;          // the one below the mouse, or held by it
  bool current = false;  // the intruder that is worked on
};

const TrajectoryPlan& plan_of(const KeyMarks& marks) {
  return marks.context.project().intruders[static_cast<std::size_t>(marks.intruder)].trajectory;
}

// At constant speed those between the first and the last are passed when the speed brings the aircraft there.
bool has_time_of_its_own(const TrajectoryPlan& plan, std::size_t waypoint) {
  const bool at_an_end = waypoint == 0 || waypoint + 1 == plan.waypoints.size();
  return plan.waypoints[waypoint].frame.has_value() && (plan.timing == Timing::frames || at_an_end);
}

void draw_key(ImDrawList& list, const KeyMarks& marks, std::size_t waypoint) {
  const auto number = static_cast<int>(waypoint);
  const bool selected = number == marks.selected;
  const bool hot = number == marks.hot;
  const ImVec2 center{std::floor(marks.strip.moment_x(marks.frames[waypoint])) + 0.5F,
                      std::floor(marks.top_y + marks.height / 2) + 0.5F};
  const float radius = scaled(hot || selected ? 6.5 : 5.5);
  const ImU32 own = faded(intruder_color(marks.intruder), marks.current || hot ? 1 : 0.75);
  const ImU32 fill =
      has_time_of_its_own(plan_of(marks), waypoint) ? (selected ? color::kWaypoint : own) : color::kPanel;
  const ImU32 edge = selected ? color::kAccent : hot ? color::kWaypoint : own;
  draw_diamond(list, center, radius, fill);
  draw_diamond(list, center, radius, edge, scaled(selected ? 2 : 1.4));
}

void draw_flags(ImDrawList& list, const KeyMarks& marks) {
  const std::shared_ptr<const Survey> survey = survey_of(marks.context, marks.intruder);
  if (survey == nullptr) return;
  const float bottom_y = marks.top_y + marks.height - 1;
  for (const FlightFlag& flag : survey->flags) {
    const auto draw = [&](float top_y, ImU32 shade) {
      draw_stretch(list, marks.strip, flag.first_frame, flag.last_frame, top_y, bottom_y, shade);
    };
    draw(marks.top_y, faded(color::kBad, 0.13));
    draw(bottom_y - scaled(2.5), color::kBad);
  }
}

void draw_flown_line(ImDrawList& list, const KeyMarks& marks) {
  if (marks.frames.empty()) return;
  const auto [first, last] = std::minmax_element(marks.frames.begin(), marks.frames.end());
  const float y = std::floor(marks.top_y + marks.height / 2);
  list.AddRectFilled({marks.strip.moment_x(*first), y}, {marks.strip.moment_x(*last), y + 1},
                     faded(intruder_color(marks.intruder), marks.current ? 0.6 : 0.3));
}

std::string key_text(const KeyMarks& marks, std::size_t waypoint) {
  const TrajectoryPlan& plan = plan_of(marks);
  const double frame = marks.frames[waypoint];
  const glm::dvec3& p = plan.waypoints[waypoint].position_m;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "waypoint %zu of %zu\nframe %.6g   %s\n%.6g, %.6g, %.6g m", waypoint + 1,
                plan.waypoints.size(), frame,
                time_text_of(marks.context, static_cast<int>(std::lround(std::clamp(frame, -1e6, 1e9)))).c_str(), p.x,
                p.y, p.z);
  std::string result = text.data();
  if (!plan.waypoints[waypoint].frame)
    result += "\nno frame of its own: spread evenly; drag to give it one";
  else if (!has_time_of_its_own(plan, waypoint))
    result += "\nat constant speed it is passed when the speed says";
  return result;
}

std::string flags_text(const KeyMarks& marks, double frame) {
  const std::shared_ptr<const Survey> survey = survey_of(marks.context, marks.intruder);
  return survey == nullptr ? "" : flags_text(*survey, frame);
}

// Keys as diamonds, hollow where the waypoint's time follows from the others; below them stretches that no such
// aircraft could fly.
void draw_key_marks(ImDrawList& list, const KeyMarks& marks) {
  const ImVec2 low{marks.strip.left(), marks.top_y};
  const ImVec2 high{marks.strip.right(), marks.top_y + marks.height};
  if (marks.current) list.AddRectFilled(low, high, IM_COL32(255, 255, 255, 9));
  draw_flags(list, marks);
  draw_flown_line(list, marks);
  float last_x = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < marks.frames.size(); ++i) {
    const float x = marks.strip.moment_x(marks.frames[i]);
    // Thousands of waypoints on a few pixels are one mark.
    if (!marks.strip.shows(marks.frames[i]) || std::abs(x - last_x) < 1) continue;
    draw_key(list, marks, i);
    last_x = x;
  }
  for (const int on_top : {marks.selected, marks.hot})
    if (on_top >= 0 && on_top < static_cast<int>(marks.frames.size()))
      draw_key(list, marks, static_cast<std::size_t>(on_top));
}

// What there is to say of the place below the mouse.
void tooltip_for_keys(const KeyMarks& marks, double mouse_frame) {
  if (marks.hot >= 0 && marks.hot < static_cast<int>(marks.frames.size()))
    return tooltip_for_item(key_text(marks, static_cast<std::size_t>(marks.hot)).c_str());
  const std::string flags = flags_text(marks, mouse_frame);
  tooltip_for_item(flags.empty() ? "double click: add a waypoint on the curve here" : flags.c_str());
}

void select(const ViewContext& context, int intruder, int waypoint) {
  const Selected kind = waypoint < 0 ? Selected::intruder : Selected::waypoint;
  context.edits.select({kind, intruder, std::max(0, waypoint)});
}

void set_frame(const ViewContext& context, int intruder, int waypoint, double frame, const std::string& gesture) {
  if (!can_fix_frames(context, intruder)) return;
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
    go_to_moment(context, frame);
  } else {
    context.edits.ask(ShowMessage{"The trajectory is not known yet; try again in a moment.", true});
  }
}

std::string gesture_of(int intruder, int waypoint) {
  return fmt::format("time {} {}", intruder, waypoint);
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

// What is worked out once for the row that is drawn.
struct KeyRows::Row {
  const TimelineStrip& strip;
  int intruder = 0;
  std::vector<double> frames;  // of its waypoints
  float top_y = 0;
  int under = -1;  // the waypoint below the mouse
};

float KeyRows::row_height() {
  return std::ceil(ImGui::GetFontSize() + scaled(6));
}

void KeyRows::probe_places(const ViewContext& context, const Row& row) {
  if (!context.ui_probe.wanted()) return;
  const std::string name = fmt::format("timeline/row/{}", row.intruder);
  context.ui_probe.note_item(name);
  const double reach = scaled(5);
  for (std::size_t i = 0; i < row.frames.size(); ++i) {
    const glm::dvec2 center{row.strip.moment_x(row.frames[i]), row.top_y + row_height() / 2};
    context.ui_probe.note(fmt::format("{}/key/{}", name, i), {center - reach, center + reach});
  }
}

void KeyRows::drag(const ViewContext& context, const Row& row) {
  Held& held = *held_;
  if (held.waypoint >= static_cast<int>(row.frames.size())) return;
  const bool leaves =
      ImGui::IsMouseDown(ImGuiMouseButton_Left) && held.gesture.has_left_press(dv(ImGui::GetMousePos()));
  if (!held.gesture.is_moving && !leaves) return;
  held.gesture.is_moving = true;
  const double now = row.frames[static_cast<std::size_t>(held.waypoint)];
  go_to_moment(context, now);  // one update behind, but where its neighbours let it go
  const double wanted = snapped(row.strip.moment_at(ImGui::GetIO().MousePos.x) + held.offset);
  if (wanted == now) return;
  set_frame(context, held.intruder, held.waypoint, wanted, held.gesture.name);
}

void KeyRows::hold(const ViewContext& context, const Row& row) {
  const bool is_cancelled = held_->gesture.cancelled_by_key(context);
  if (is_cancelled && held_->gesture.is_moving) go_to_moment(context, held_->frame_before);
  if (is_cancelled || held_->gesture.is_lost(context))
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
      go_to_moment(context, frame);
      held_ = Held{.intruder = row.intruder,
                   .waypoint = row.under,
                   .offset = frame - row.strip.moment_at(ImGui::GetIO().MousePos.x),
                   .frame_before = frame,
                   .gesture = drag_gesture_at(context, dv(ImGui::GetMousePos()), gesture_of(row.intruder, row.under))};
    }
  }
  if (ImGui::IsItemActive() && held_ && held_->intruder == row.intruder) hold(context, row);
  if (ImGui::IsItemDeactivated() && held_) {
    hold(context, row);
    if (held_) held_->gesture.end(context);
    held_.reset();
  }
}

void KeyRows::draw_key_menu(const ViewContext& context) {
  ImGui::TextDisabled("waypoint %d, frame %.6g", menu_.waypoint + 1, menu_.frame);
  ImGui::Separator();
  if (ImGui::MenuItem("Go to")) go_to_moment(context, menu_.frame);
  if (ImGui::MenuItem("Duplicate", "Ctrl+D")) duplicate_selected(context);
  if (ImGui::MenuItem("Delete", "Del")) delete_selected(context);
  if (!ImGui::BeginMenu("Set frame...")) return;
  ImGui::SetNextItemWidth(scaled(110));
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputDouble("##frame", &menu_.typed, 0, 0, "%.6g", ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if ((ImGui::Button("Set") || entered) && std::isfinite(menu_.typed)) {
    set_frame(context, menu_.intruder, menu_.waypoint, menu_.typed, {});
    go_to_moment(context, menu_.typed);
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
    if (ImGui::MenuItem("Go there")) go_to_moment(context, menu_.frame);
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
