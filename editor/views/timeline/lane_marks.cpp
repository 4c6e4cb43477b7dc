// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lane_marks.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

// Room between the curve and the lane's edges.
LaneBox box_of(const LaneMarks& marks) {
  const float inset = scaled(3);
  return {.top_y = marks.top_y + inset, .height = std::max(1.0F, marks.height - 2 * inset)};
}

float y_of(const LaneMarks& marks, double value) {
  const LaneBox box = box_of(marks);
  return static_cast<float>(box.top_y + (1 - marks.values.scale.share_of(value)) * box.height);
}

std::optional<std::size_t> index_of(const LaneMarks& marks, int frame, std::size_t count) {
  if (marks.survey == nullptr || frame < marks.survey->first_frame) return std::nullopt;
  const auto index = static_cast<std::size_t>(frame - marks.survey->first_frame);
  return index < count ? std::optional(index) : std::nullopt;
}

std::optional<double> value_at(const LaneMarks& marks, int frame) {
  const auto index = index_of(marks, frame, marks.values.values.size());
  if (!index || !std::isfinite(marks.values.values[*index])) return std::nullopt;
  return marks.values.values[*index];
}

// Text on a dark ground beside x, on the side where there is room.
void draw_label(ImDrawList& list, const LaneMarks& marks, float x, float y, ImU32 shade, const std::string& text) {
  ImGui::PushFont(font(Font::small));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float gap = scaled(6);
  const float left = x + gap + size.x <= marks.strip.right() ? x + gap : x - gap - size.x;
  const float top = std::clamp(y - size.y / 2, marks.top_y, std::max(marks.top_y, marks.top_y + marks.height - size.y));
  list.AddRectFilled({left - scaled(2), top}, {left + size.x + scaled(2), top + size.y}, faded(color::kPanel, 0.8),
                     scaled(2));
  list.AddText({std::floor(left), std::floor(top)}, shade, text.c_str());
  ImGui::PopFont();
}

void draw_visibility_states(ImDrawList& list, const LaneMarks& marks) {
  const std::vector<VisibilityEstimate>& estimates = marks.survey->estimates;
  const TimeRuler& ruler = marks.strip.ruler;
  const auto size = static_cast<double>(estimates.size());
  const double first = marks.survey->first_frame;
  const auto from = static_cast<std::size_t>(std::clamp(std::floor(ruler.first) - first, 0.0, size));
  const auto to = static_cast<std::size_t>(std::clamp(std::ceil(ruler.first + ruler.count) - first, 0.0, size));
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(ruler.count / std::max(1.0, ruler.width))));
  const float inset = scaled(4);
  for (std::size_t i = from; i < to;) {
    std::size_t end = i + stride;
    while (end < to && estimates[end].visibility_state == estimates[i].visibility_state) end += stride;
    end = std::min(end, to);
    list.AddRectFilled({marks.strip.edge_x(first + static_cast<double>(i)), marks.top_y + inset},
                       {marks.strip.edge_x(first + static_cast<double>(end)), marks.top_y + marks.height - inset},
                       faded(color_of(estimates[i].visibility_state), 0.85));
    i = end;
  }
}

void draw_curve(ImDrawList& list, const LaneMarks& marks) {
  const LaneStyle& style = style_of(marks.lane);
  const LaneScale& scale = marks.values.scale;
  if (style.reference && *style.reference > scale.low && *style.reference < scale.high) {
    const float y = std::floor(y_of(marks, *style.reference));
    list.AddRectFilled({marks.strip.left(), y}, {marks.strip.right(), y + 1}, faded(color::kFaint, 0.12));
  }
  const float thickness = std::max(1.5F, scaled(1.5));
  static_assert(sizeof(glm::vec2) == sizeof(ImVec2));
  std::vector<ImVec2> points;
  for (const Polyline& line :
       curve_of(marks.values.values, marks.survey->first_frame, marks.strip.ruler, scale, box_of(marks))) {
    points.clear();
    for (const glm::vec2 point : line) points.emplace_back(point.x, point.y);
    list.AddPolyline(points.data(), static_cast<int>(points.size()), style.color, ImDrawFlags_None, thickness);
    if (points.size() == 1) list.AddCircleFilled(points.front(), thickness, style.color, 8);
  }
}

void draw_flags(ImDrawList& list, const LaneMarks& marks) {
  for (const FlightFlag& flag : marks.survey->flags) {
    if (!belongs_to(flag.fault, marks.lane)) continue;
    const float low = std::max(marks.strip.left(), marks.strip.moment_x(flag.first_frame));
    const float high = std::min(marks.strip.right(), std::max(low + scaled(2), marks.strip.moment_x(flag.last_frame)));
    if (high <= low) continue;
    list.AddRectFilled({low, marks.top_y}, {high, marks.top_y + marks.height}, faded(color::kBad, 0.2));
    const float limit_y = std::floor(y_of(marks, flag.limit));
    list.AddRectFilled({low, limit_y}, {high, limit_y + 1}, faded(color::kBad, 0.8));
  }
}

// A tick where it comes nearest.
void draw_closest(ImDrawList& list, const LaneMarks& marks) {
  const ClosestApproach& closest = marks.survey->closest;
  if (!(closest.distance_m > 0) || !marks.strip.shows(closest.frame)) return;
  const float x = std::floor(marks.strip.moment_x(closest.frame));
  const float y = y_of(marks, closest.distance_m);
  const float side = scaled(4);
  list.AddRectFilled({x, marks.top_y + scaled(2)}, {x + 1, marks.top_y + marks.height}, faded(color::kText, 0.3));
  list.AddTriangleFilled({x + 0.5F, y + 1}, {x + 0.5F + side, y - side * 1.4F}, {x + 0.5F - side, y - side * 1.4F},
                         color::kText);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "nearest %s at %.1f", value_text(Lane::distance, closest.distance_m).c_str(),
                closest.frame);
  draw_label(list, marks, x, marks.top_y + marks.height * 0.3F, color::kText, text.data());
}

void list_values(const Survey& survey, std::size_t i) {
  ImGui::BeginTable("values", 2, ImGuiTableFlags_SizingFixedFit);
  for (int number = 0; number < kLanes; ++number) {
    const auto lane = static_cast<Lane>(number);
    if (lane != Lane::visibility_state && i >= survey.flight.size()) continue;
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", style_of(lane).title);
    ImGui::TableNextColumn();
    const std::string text = lane == Lane::visibility_state ? name_of(survey.estimates[i].visibility_state)
                                                            : value_text(lane, value_in(survey, lane, i));
    ImGui::TextUnformatted(text.c_str());
  }
  ImGui::EndTable();
}

std::string flags_at(const LaneMarks& marks, int frame) {
  std::string text;
  for (const FlightFlag& flag : marks.survey->flags) {
    const bool is_reported_here = marks.lane == Lane::visibility_state || belongs_to(flag.fault, marks.lane);
    if (is_reported_here && frame >= flag.first_frame - 1 && frame <= flag.last_frame + 1)
      text.append(text.empty() ? "" : "\n").append(flag.text());
  }
  return text;
}

void list_colors() {
  ImGui::Separator();
  for (const VisibilityState visibility_state : {VisibilityState::in_view, VisibilityState::partly_occluded,
                                                 VisibilityState::occluded, VisibilityState::out_of_view}) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetFontSize();
    ImGui::Dummy({side, side});
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + side * 0.25F}, {at.x + side * 0.8F, at.y + side * 0.85F},
                                              color_of(visibility_state));
    ImGui::SameLine();
    ImGui::TextDisabled("%s",
                        visibility_state == VisibilityState::in_view || visibility_state == VisibilityState::out_of_view
                            ? name_of(visibility_state)
                            : (std::string(name_of(visibility_state)) + " by the own body").c_str());
  }
}

}  // namespace

void draw_lane_marks(ImDrawList& list, const LaneMarks& marks) {
  if (marks.survey == nullptr) {
    draw_label(list, marks, marks.strip.left(), marks.top_y + marks.height / 2, color::kQuiet, "not known yet");
    return;
  }
  if (marks.lane == Lane::visibility_state) {
    draw_visibility_states(list, marks);
    return;
  }
  draw_flags(list, marks);
  draw_curve(list, marks);
  if (marks.lane == Lane::distance) draw_closest(list, marks);
}

void draw_value_dot(ImDrawList& list, const LaneMarks& marks, int frame) {
  const std::optional<double> value = value_at(marks, frame);
  if (!value) return;
  const ImVec2 center{marks.strip.moment_x(frame), y_of(marks, *value)};
  list.AddCircleFilled(center, scaled(3.5), color::kPanel, 10);
  list.AddCircleFilled(center, scaled(2.5), style_of(marks.lane).color, 10);
}

void draw_hover(ImDrawList& list, const LaneMarks& marks, int frame) {
  const std::string text = lane_text_at(marks, frame);
  if (text == "-") return;
  const float x = std::floor(marks.strip.moment_x(frame));
  list.AddRectFilled({x, marks.top_y}, {x + 1, marks.top_y + marks.height}, faded(color::kText, 0.5));
  draw_value_dot(list, marks, frame);
  draw_label(list, marks, x, marks.top_y + marks.height / 2, color::kText, text + " at " + std::to_string(frame));
}

void tooltip_for_lanes(const ViewContext& context, const LaneMarks& marks, int frame) {
  const auto index = index_of(marks, frame, marks.survey == nullptr ? 0 : marks.survey->estimates.size());
  if (!index || !item_wants_tooltip()) return;
  const std::string flags = flags_at(marks, frame);
  // Over a curve its value stands beside the mouse already.
  if (marks.lane != Lane::visibility_state && flags.empty()) return;
  ImGui::BeginTooltip();
  if (marks.lane == Lane::visibility_state) {
    ImGui::Text("frame %d   %s", frame, time_text_of(context, frame).c_str());
    list_values(*marks.survey, *index);
  }
  if (!flags.empty()) ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(color::kBad), "%s", flags.c_str());
  if (marks.lane == Lane::visibility_state) list_colors();
  ImGui::EndTooltip();
}

std::string lane_text_at(const LaneMarks& marks, int frame) {
  if (marks.lane == Lane::visibility_state) {
    const auto index = index_of(marks, frame, marks.survey == nullptr ? 0 : marks.survey->estimates.size());
    return index ? name_of(marks.survey->estimates[*index].visibility_state) : "-";
  }
  const std::optional<double> value = value_at(marks, frame);
  return value ? value_text(marks.lane, *value) : "-";
}

}  // namespace sigs::editor
