// SPDX-License-Identifier: MIT
#include "editor/views/inspector/inspector_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ensure.h"
#include "editor/document/project_edits.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr int kMaxRows = 9;  // before the table scrolls

const std::vector<WaypointSettings>& waypoints_of(const ViewContext& context, int intruder) {
  return context.project().intruders[static_cast<std::size_t>(intruder)].trajectory.waypoints;
}

std::optional<int> selected_waypoint(const ViewContext& context, int intruder) {
  const Selection& selection = context.document.selection();
  const bool is_here = selection.kind == Selected::waypoint && selection.intruder == intruder;
  return is_here ? std::optional(selection.waypoint) : std::nullopt;
}

std::string waypoint_key(int intruder, int waypoint) {
  return fmt::format("intruders[{}].trajectory.waypoints[{}]", intruder, waypoint);
}

constexpr int kHeadingColumn = 5;

// Column titles in the colours of the axes.
void draw_titles(int columns) {
  constexpr std::array<const char*, 6> kTitles{"#", "Frame", "X (m)", "Y (m)", "Z (m)", "Nose"};
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int column = 0; column < columns; ++column) {
    ImGui::TableSetColumnIndex(column);
    const bool is_axis = column >= 2 && column < kHeadingColumn;
    const ImU32 shade = !is_axis ? color::kQuiet : color::kAxes[static_cast<std::size_t>(column - 2)];
    draw_text(kTitles[static_cast<std::size_t>(column)], shade);
  }
}

constexpr int kMaxProblems = 3;

// Of the waypoints as a whole and of single ones, above their table.
void draw_problems(FieldRows& rows, const std::string& prefix) {
  int shown = 0;
  std::string last;
  const ProblemsByField& problems = rows.problems();
  for (auto found = problems.lower_bound(prefix); found != problems.end() && found->first.starts_with(prefix);
       ++found) {
    if (found->first == last || rows.sheet().find(found->first) != nullptr) continue;
    last = found->first;
    if (++shown > kMaxProblems) break;
    const std::size_t bracket = last.find("waypoints[");
    if (bracket != std::string::npos) {
      const std::string number = last.substr(bracket + 10, last.find(']', bracket) - bracket - 10);
      note("Waypoint " + number, true);
    }
    rows.problem_lines(last);
  }
}

constexpr std::size_t kMaxFlags = 12;

std::string tenths(double value, double step = 0.1) {
  return number_text(std::round(value / step) * step);
}

void note_row(FieldRows& rows, const char* label, const std::string& text, const char* tooltip) {
  (void)rows.begin_row(label);
  draw_wrapped(text, color::kQuiet);
  tooltip_for_item(tooltip);
}

std::string frames_text(const FlightFlag& flag) {
  const long first = std::lround(flag.first_frame);
  const long last = std::lround(flag.last_frame);
  return first == last ? fmt::format("frame {}", first) : fmt::format("frames {} to {}", first, last);
}

}  // namespace

WaypointTable::WaypointTable() : example_(std::make_unique<Project>()) {
  example_->intruders.resize(1);
  example_->intruders[0].trajectory.waypoints.resize(1);
  example_fields_ = fields_of(*example_);
  for (const Field& field : example_fields_) {
    if (field.key.ends_with("waypoints[0].frame")) frame_field_ = &field;
    if (field.key.ends_with("waypoints[0].position_m")) position_field_ = &field;
    if (field.key.ends_with("waypoints[0].heading_deg")) heading_field_ = &field;
  }
  ENSURE(frame_field_ != nullptr && position_field_ != nullptr && heading_field_ != nullptr);
}

void WaypointTable::refresh(const ViewContext& context, int intruder) {
  const Document& document = context.document;
  const bool is_same = revision_ == document.revision().number && intruder_ == intruder &&
                       range_first_ == document.first_frame() && range_last_ == document.last_frame();
  if (is_same) return;
  revision_ = document.revision().number;
  intruder_ = intruder;
  range_first_ = document.first_frame();
  range_last_ = document.last_frame();
  frames_ = frames_of_waypoints(context, intruder);
}

void WaypointTable::draw_frame(const ViewContext& context, Typing& typing, int intruder, int waypoint) {
  const auto index = static_cast<std::size_t>(waypoint);
  const bool is_own = waypoints_of(context, intruder)[index].frame.has_value();
  double frame = frames_[index];
  if (!is_own) ImGui::PushStyleColor(ImGuiCol_Text, color::kQuiet);
  const bool has_changed = number_input("##frame", frame, *frame_field_, ImGui::GetContentRegionAvail().x, typing);
  if (!is_own) ImGui::PopStyleColor();
  tooltip_for_item(is_own ? "Frame in which it is passed; drag, or click to type"
                          : "Spread evenly between its neighbours; give it a frame by dragging or typing");
  if (ImGui::IsItemActivated()) context.edits.select({Selected::waypoint, intruder, waypoint});
  if (has_changed && can_fix_frames(context, intruder))
    context.edits.change(
        "move waypoint in time",
        [=, frames = frames_](Project& project) {
          TrajectoryPlan& plan = project.intruders[static_cast<std::size_t>(intruder)].trajectory;
          move_waypoint_in_time(plan, waypoint, frame, frames);
        },
        "inspector frame " + waypoint_key(intruder, waypoint));
  if (ImGui::IsItemDeactivated() || (has_changed && !ImGui::IsItemActive())) context.edits.end_gesture();
}

void WaypointTable::draw_position(const ViewContext& context, Typing& typing, int intruder, int waypoint) {
  constexpr std::array<const char*, 3> kIds{"##x", "##y", "##z"};
  Field part = *position_field_;
  part.unit = "";  // in the title
  glm::dvec3 position_m = waypoints_of(context, intruder)[static_cast<std::size_t>(waypoint)].position_m;
  for (int axis = 0; axis < 3; ++axis) {
    ImGui::TableSetColumnIndex(2 + axis);
    const char* const id = kIds[static_cast<std::size_t>(axis)];
    const bool has_changed = number_input(id, position_m[axis], part, ImGui::GetContentRegionAvail().x, typing);
    if (has_changed)
      context.edits.move_waypoint(intruder, waypoint, position_m, gesture_of_waypoint(intruder, waypoint));
    if (ImGui::IsItemActivated()) context.edits.select({Selected::waypoint, intruder, waypoint});
    if (ImGui::IsItemDeactivated() || (has_changed && !ImGui::IsItemActive())) context.edits.end_gesture();
  }
}

void WaypointTable::draw_heading(const ViewContext& context, Typing& typing, int intruder, int waypoint) {
  const std::optional<double> given = waypoints_of(context, intruder)[static_cast<std::size_t>(waypoint)].heading_deg;
  const auto turn = [&](std::optional<double> heading_deg) {
    turn_waypoint(context, intruder, waypoint, heading_deg, "inspector heading " + waypoint_key(intruder, waypoint));
  };
  ImGui::TableSetColumnIndex(kHeadingColumn);
  Field field = *heading_field_;
  field.unit = "";  // in the title
  double heading_deg = given.value_or(0);
  if (!given) ImGui::PushStyleColor(ImGuiCol_Text, color::kQuiet);
  const bool has_changed = number_input("##heading", heading_deg, field, ImGui::GetContentRegionAvail().x, typing);
  if (has_changed) turn(heading_deg);
  if (!given) ImGui::PopStyleColor();
  tooltip_for_item(given ? "Where the nose points, from world X to the right; a right click leaves it to the others"
                         : "By the other waypoints' headings, else the path's; give it one by dragging or typing");
  if (ImGui::IsItemActivated()) context.edits.select({Selected::waypoint, intruder, waypoint});
  if (ImGui::IsItemDeactivated() || (has_changed && !ImGui::IsItemActive())) context.edits.end_gesture();
  if (!given || !ImGui::IsItemClicked(ImGuiMouseButton_Right)) return;
  turn(std::nullopt);
  context.edits.end_gesture();
}

void WaypointTable::draw_row(const ViewContext& context, Typing& typing, int intruder, int waypoint, bool is_wrong) {
  const bool is_selected = selected_waypoint(context, intruder) == waypoint;
  ImGui::TableNextRow();
  if (is_selected) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, color::kAccentSoft);
  ImGui::TableSetColumnIndex(0);
  ImGui::AlignTextToFramePadding();
  const std::string number = std::to_string(waypoint + 1);  // as on the timeline and in menus
  if (is_wrong) ImGui::PushStyleColor(ImGuiCol_Text, color::kBad);
  if (ImGui::Selectable(number.c_str(), false, ImGuiSelectableFlags_AllowDoubleClick)) {
    context.edits.select({Selected::waypoint, intruder, waypoint});
    const double frame = std::round(frames_[static_cast<std::size_t>(waypoint)]);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
      context.edits.go_to_frame(static_cast<int>(std::clamp(frame, 0.0, 1e9)));
  }
  if (is_wrong) ImGui::PopStyleColor();
  context.ui_probe.note_item("inspector/waypoint " + number, "Click selects, double click goes to its frame");
  ImGui::TableSetColumnIndex(1);
  draw_frame(context, typing, intruder, waypoint);
  context.ui_probe.note_item(fmt::format("inspector/waypoint {}/frame", number));
  draw_position(context, typing, intruder, waypoint);
  if (!has_headings(context, intruder)) return;
  draw_heading(context, typing, intruder, waypoint);
  context.ui_probe.note_item(fmt::format("inspector/waypoint {}/heading", number));
}

// What was selected elsewhere comes into sight.
void WaypointTable::scroll_to_selected(const ViewContext& context, int intruder, float row_height) {
  const Selection& selection = context.document.selection();
  if (selection == shown_) return;
  shown_ = selection;
  const std::optional<int> waypoint = selected_waypoint(context, intruder);
  if (!waypoint) return;
  const float top = static_cast<float>(*waypoint) * row_height;
  const float room = ImGui::GetWindowHeight() - 2 * row_height;
  const float scroll = ImGui::GetScrollY();
  if (top < scroll || top > scroll + room) ImGui::SetScrollY(std::max(0.0F, top - room / 2));
}

void WaypointTable::draw_rows(const ViewContext& context, const FieldRows& rows, int intruder) {
  const auto count = static_cast<int>(waypoints_of(context, intruder).size());
  const float row_height = ImGui::GetFrameHeight() + 2 * scaled(1);
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = has_headings(context, intruder) ? 6 : 5;
  const float number_width = scaled(columns == 6 ? 18 : 30);
  // Headings take three digits: the column of frames gives them room.
  const float short_width = scaled(42);
  const float minimum =
      columns == 6 ? number_width + 2 * short_width + 3 * scaled(54) + 6 * scaled(4) : scaled(34) + 4 * scaled(58);
  const float height = row_height * static_cast<float>(std::min(count, kMaxRows)) + ImGui::GetTextLineHeight() +
                       scaled(8) + (room < minimum ? ImGui::GetStyle().ScrollbarSize : 0);
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_ScrollX | ImGuiTableFlags_RowBg |
                                     ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {scaled(2), scaled(1)});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {scaled(4), ImGui::GetStyle().FramePadding.y});
  if (ImGui::BeginTable("waypoints", columns, kFlags, {0, height})) {
    const bool scrolls = count > kMaxRows;
    const float usable = room - number_width - scaled(4) - static_cast<float>(columns) * scaled(4) -
                         (scrolls ? ImGui::GetStyle().ScrollbarSize : 0);
    const float each = columns == 6 ? std::max(scaled(54), std::floor((usable - 2 * short_width) / 3))
                                    : std::max(scaled(54), std::floor(usable / 4));
    ImGui::TableSetupScrollFreeze(1, 1);
    ImGui::TableSetupColumn("#", ImGuiTableColumnFlags_WidthFixed, number_width);
    ImGui::TableSetupColumn("frame", ImGuiTableColumnFlags_WidthFixed, columns == 6 ? short_width : each);
    for (const char* const title : {"x", "y", "z"})
      ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthFixed, each);
    if (columns == 6) ImGui::TableSetupColumn("nose", ImGuiTableColumnFlags_WidthFixed, short_width);
    draw_titles(columns);
    ImGuiListClipper clipper;
    clipper.Begin(count);
    while (clipper.Step())
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        ImGui::PushID(i);
        draw_row(context, rows.typing(), intruder, i, has_problem(rows.problems(), waypoint_key(intruder, i)));
        ImGui::PopID();
      }
    scroll_to_selected(context, intruder, row_height);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar(2);
}

// Half way in time to the next one, on the curve.
void WaypointTable::insert_after(const ViewContext& context, int intruder, int waypoint) const {
  const auto index = static_cast<std::size_t>(waypoint);
  const std::vector<WaypointSettings>& waypoints = waypoints_of(context, intruder);
  if (index + 1 >= waypoints.size()) return;
  const double frame = std::round((frames_[index] + frames_[index + 1]) / 2);
  const glm::dvec3 between_m = (waypoints[index].position_m + waypoints[index + 1].position_m) / 2.0;
  add_waypoint(context, intruder, frame, position_of(context, intruder, frame).value_or(between_m));
}

void WaypointTable::draw_buttons(const ViewContext& context, int intruder) const {
  const std::optional<int> chosen = selected_waypoint(context, intruder);
  const std::size_t count = frames_.size();
  const auto after = static_cast<std::size_t>(chosen.value_or(0)) + 1;
  const bool has_room = chosen && after < count && frames_[after] - frames_[after - 1] >= 2 * kMinGap_frames;
  ButtonFlow flow;
  if (context.ui_probe.noted(flow.button("Add here", "A waypoint in the playhead's frame, on the trajectory (Enter)"),
                             "inspector/add waypoint"))
    add_waypoint_here(context);
  if (context.ui_probe.noted(
          flow.button("Insert", "A waypoint on the curve, half way between this one and the next", has_room),
          "inspector/insert waypoint"))
    insert_after(context, intruder, *chosen);
  if (flow.button("Duplicate##waypoint", "A copy of this one, farther on (Ctrl + D)", chosen.has_value()))
    duplicate_selected(context);
  if (context.ui_probe.noted(flow.button("Delete##waypoint", "Takes this waypoint out (Delete)", chosen && count > 1),
                             "inspector/delete waypoint"))
    delete_selected(context);
}

void WaypointTable::draw(const ViewContext& context, const FieldRows& rows, int intruder) {
  refresh(context, intruder);
  if (!frames_.empty()) draw_rows(context, rows, intruder);
  draw_buttons(context, intruder);
}

void TrajectoryBlock::draw(const ViewContext& context, FieldRows& rows) {
  const std::optional<int> intruder = current_intruder(context);
  if (!intruder) return note("No intruder yet. Add one above.");
  const std::string key = fmt::format("intruders[{}].trajectory.", *intruder);
  const TrajectoryPlan& plan = context.project().intruders[static_cast<std::size_t>(*intruder)].trajectory;
  rows.rows(key, [&](const Field& field) {
    RowOptions look;
    const bool is_of_limit = field.key.ends_with("bank_limit_deg");
    if (plan.attitude == AttitudeKind::balloon && is_of_limit) look.off_because = "A balloon stays level.";
    if (plan.attitude != AttitudeKind::path && field.key.ends_with(".bank")) look.off_because = "Its thrust tilts it.";
    if (plan.attitude == AttitudeKind::path && plan.bank == Bank::level && is_of_limit)
      look.off_because = "The wings stay level.";
    return look;
  });
  ImGui::Spacing();
  note("Waypoints");
  draw_problems(rows, key);
  rows.guess_lines(key.substr(0, key.size() - 1));
  rows.guess_lines(key + "waypoints");
  waypoints_.draw(context, rows, *intruder);
  ImGui::Spacing();
  note("Flight");
  flight_.draw(context, rows, *intruder);
}

Visibility visibility_of(const Survey& survey, int frames) {
  Visibility visibility{.frames = frames};
  for (const VisibilityEstimate& estimate : survey.estimates) add(visibility, estimate);
  return visibility;
}

void FlightSummary::measure(const std::shared_ptr<const Survey>& survey) {
  if (survey == measured_) return;
  measured_ = survey;
  if (survey->flight.empty()) return;
  visibility_ = text_of(visibility_of(*survey, static_cast<int>(survey->estimates.size())));
  const auto span = [&](auto value) {
    const auto [minimum, maximum] =
        std::minmax_element(survey->flight.begin(), survey->flight.end(),
                            [&](const auto& a, const auto& b) { return value(a) < value(b); });
    return Span{value(*minimum), value(*maximum)};
  };
  speed_mps_ = span([](const FlightState& state) { return state.speed_mps; });
  // The largest one is that of the whole force, as the faults have it: across the wings too.
  load_ = {
      span([](const FlightState& state) { return state.load_factor; }).minimum,
      span([](const FlightState& state) { return std::hypot(state.load_factor, state.side_load_factor); }).maximum};
  climb_mps_ = span([](const FlightState& state) { return state.climb_rate_mps; });
}

void FlightSummary::draw(const ViewContext& context, FieldRows& rows, int intruder) {
  const std::shared_ptr<const Survey> shown = survey_of(context, intruder);
  if (!shown || shown->flight.empty()) return note("The flight has not been looked at yet.");
  const Survey& survey = *shown;
  measure(shown);
  note_row(rows, "Speed", fmt::format("{} to {} m/s", tenths(speed_mps_.minimum), tenths(speed_mps_.maximum)),
           "Minimum and maximum");
  note_row(rows, "Load factor", fmt::format("{} to {} g", tenths(load_.minimum, 0.01), tenths(load_.maximum, 0.01)),
           "Force by weight; 1 in level flight, negative where it pushes down");
  note_row(rows, "Climb", fmt::format("{} to {} m/s", tenths(climb_mps_.minimum), tenths(climb_mps_.maximum)),
           "Up is positive");
  note_row(rows, "Seen", visibility_, "Estimated without drawing; size: the longer side of its silhouette");
  (void)rows.begin_row("Closest");
  frame_link(context, fmt::format("{} m, frame {}", tenths(survey.closest.distance_m), tenths(survey.closest.frame)),
             survey.closest.frame, color::kAccent);
  for (std::size_t i = 0; i < std::min(survey.flags.size(), kMaxFlags); ++i) {
    const FlightFlag& flag = survey.flags[i];
    std::string text = fmt::format("{} ({})", flag.text(), frames_text(flag));
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    frame_link(context, text, flag.first_frame, color::kPartly);
  }
  if (survey.flags.size() > kMaxFlags) note(fmt::format("{} more", survey.flags.size() - kMaxFlags), true);
}

}  // namespace sigs::editor
