// SPDX-License-Identifier: MIT
#include "editor/views/timeline/key_marks.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

const TrajectoryPlan& plan_of(const KeyMarks& marks) {
  return marks.context.project().intruders[static_cast<std::size_t>(marks.intruder)].trajectory;
}

// At constant speed those between the first and the last are passed when the speed brings the aircraft there.
bool has_time_of_its_own(const TrajectoryPlan& plan, std::size_t waypoint) {
  const bool at_an_end = waypoint == 0 || waypoint + 1 == plan.waypoints.size();
  return plan.waypoints[waypoint].frame.has_value() && (plan.timing == TimingChoice::frames || at_an_end);
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
  const std::array<ImVec2, 4> corners{ImVec2{center.x, center.y - radius},
                                      {center.x + radius, center.y},
                                      {center.x, center.y + radius},
                                      {center.x - radius, center.y}};
  list.AddConvexPolyFilled(corners.data(), 4, fill);
  list.AddPolyline(corners.data(), 4, edge, ImDrawFlags_Closed, scaled(selected ? 2 : 1.4));
}

void draw_flags(ImDrawList& list, const KeyMarks& marks) {
  const Survey* survey = survey_of(marks.context, marks.intruder);
  if (survey == nullptr) return;
  const float bottom_y = marks.top_y + marks.height - 1;
  for (const FlightFlag& flag : survey->flags) {
    const float low = std::max(marks.strip.left(), marks.strip.moment_x(flag.first_frame));
    const float high = std::min(marks.strip.right(), std::max(low + scaled(2), marks.strip.moment_x(flag.last_frame)));
    if (high <= low) continue;
    list.AddRectFilled({low, marks.top_y}, {high, bottom_y}, faded(color::kBad, 0.13));
    list.AddRectFilled({low, bottom_y - scaled(2.5)}, {high, bottom_y}, color::kBad);
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
  const Survey* survey = survey_of(marks.context, marks.intruder);
  std::string text;
  if (survey == nullptr) return text;
  for (const FlightFlag& flag : survey->flags)
    if (frame >= flag.first_frame - 1 && frame <= flag.last_frame + 1)
      text.append(text.empty() ? "" : "\n").append(flag.text());
  return text;
}

}  // namespace

const Survey* survey_of(const ViewContext& context, int intruder) {
  const auto index = static_cast<std::size_t>(intruder);
  return index < context.shown.surveys.size() ? context.shown.surveys[index].get() : nullptr;
}

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

void tooltip_for_keys(const KeyMarks& marks, double mouse_frame) {
  if (marks.hot >= 0 && marks.hot < static_cast<int>(marks.frames.size())) {
    tooltip_for_item(key_text(marks, static_cast<std::size_t>(marks.hot)).c_str());
    return;
  }
  const std::string flags = flags_text(marks, mouse_frame);
  tooltip_for_item(flags.empty() ? "double click: add a waypoint on the curve here" : flags.c_str());
}

}  // namespace sigs::editor
