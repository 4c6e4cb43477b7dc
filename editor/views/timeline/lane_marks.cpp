// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace sigs::editor {

namespace {

// One standard deviation to both sides of a lane's curve, where it is known, as a pale band; no finer than the screen.
// first_frame: that of the lane's first value, as a frame of the footage.
void draw_deviation_band(ImDrawList& list, const TimelineStrip& strip, const LaneValues& lane, int first_frame,
                         const LaneBox& box, ImU32 shade) {
  if (lane.deviations.empty()) return;
  const auto y_of = [&](double value) {
    return static_cast<float>(box.top_y + (1 - lane.scale.share_of(value)) * box.height);
  };
  const double stride = std::max(1.0, std::ceil(strip.ruler.count / std::max(1.0, strip.ruler.width)));
  const double first = first_frame;
  const auto count = static_cast<double>(lane.deviations.size());
  const double from = std::clamp(std::floor((strip.ruler.first - first) / stride) * stride, 0.0, count);
  const double to = std::clamp(strip.ruler.first + strip.ruler.count + stride - first, 0.0, count);
  for (double i = from; i < to; i += stride) {
    const auto index = static_cast<std::size_t>(i);
    const double sd = lane.deviations[index];
    if (!std::isfinite(sd)) continue;
    const double value = lane.values[index];
    list.AddRectFilled({strip.edge_x(first + i), y_of(value + sd)},
                       {strip.edge_x(first + i + stride), y_of(value - sd)}, shade);
  }
}

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

void draw_curve(ImDrawList& list, const LaneMarks& marks) {
  const LaneStyle& style = marks.style;
  draw_deviation_band(list, marks.strip, marks.values, marks.survey->first_frame, box_of(marks),
                      faded(style.color, 0.25));
  const LaneScale& scale = marks.values.scale;
  if (style.reference && *style.reference > scale.low && *style.reference < scale.high) {
    draw_level(list, marks.strip, y_of(marks, *style.reference), faded(color::kFaint, 0.12));
  }
  draw_polylines(list,
                 curve_of(marks.values.values, marks.survey->first_frame, marks.strip.ruler, scale, box_of(marks)),
                 style.color);
}

void draw_flags(ImDrawList& list, const LaneMarks& marks) {
  for (const FlightFlag& flag : marks.survey->flags) {
    if (marks.style.fault != flag.fault) continue;
    const auto draw = [&](float top_y, float bottom_y, double opacity) {
      draw_stretch(list, marks.strip, flag.first_frame, flag.last_frame, top_y, bottom_y, faded(color::kBad, opacity));
    };
    draw(marks.top_y, marks.top_y + marks.height, 0.2);
    const float limit_y = std::floor(y_of(marks, flag.limit));
    draw(limit_y, limit_y + 1, 0.8);
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

// What all lanes say of a frame.
void list_values(const Survey& survey, std::size_t i) {
  ImGui::BeginTable("values", 2, ImGuiTableFlags_SizingFixedFit);
  for (const LaneStyle& style : lane_styles()) {
    if (style.is_of_camera() && survey.camera.empty()) continue;
    if (style.is_of_encounter() && !survey.encounter) continue;
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", style.title);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text_in(survey, style.lane, i).c_str());
  }
  ImGui::EndTable();
}

// Over a strip all that is wrong with the flight there, over a curve what belongs to it.
std::string flags_at(const LaneMarks& marks, int frame) {
  if (marks.style.is_strip()) return flags_text(*marks.survey, frame);
  return marks.style.fault ? flags_text(*marks.survey, frame, marks.style.fault) : "";
}

// The coloured stretches of a strip.
void draw_strip(ImDrawList& list, const LaneMarks& marks) {
  if (marks.style.lane == Lane::visibility)
    draw_visibility_strip(list, marks.strip, *marks.survey, marks.top_y, marks.height);
  if (marks.style.lane == Lane::clear)
    draw_clear_strip(list, marks.strip, *marks.survey->encounter, marks.top_y, marks.height);
}

// What the colours of a strip mean.
void list_colors(Lane lane) {
  if (lane == Lane::visibility) list_visibility_colors();
  if (lane == Lane::clear) list_clear_colors();
}

// The mark under the mouse, and the state of each volume.
void tell_encounter(const LaneMarks& marks, int frame) {
  const std::vector<EncounterMark> all = encounter_marks(*marks.survey->encounter);
  if (const EncounterMark* const mark = mark_at(all, marks.strip, static_cast<double>(ImGui::GetMousePos().x)))
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(color::kAccent), "%s", mark->text.c_str());
  ImGui::TextUnformatted(clear_lines(*marks.survey->encounter, frame).c_str());
}

// Of the lanes of the encounter: when well clear is lost, and a line at the limit that the lane shows.
void draw_encounter(ImDrawList& list, const LaneMarks& marks) {
  const EncounterSurvey& encounter = *marks.survey->encounter;
  if (encounter.volumes.empty()) return;
  draw_loss_ground(list, marks.strip, encounter, marks.top_y, marks.height);
  const WellClearVolume& volume = encounter.volumes.front().volume;
  const double limit = marks.style.lane == Lane::beside ? volume.dmod_m : volume.tau_mod_s;
  if (limit <= 0 || limit >= marks.values.scale.high) return;
  draw_level(list, marks.strip, y_of(marks, limit), faded(color::kBad, 0.6));
}

}  // namespace

void draw_stretch(ImDrawList& list, const TimelineStrip& strip, double first_frame, double last_frame, float top_y,
                  float bottom_y, ImU32 shade) {
  const float low = std::max(strip.left(), strip.moment_x(first_frame));
  const float high = std::min(strip.right(), std::max(low + scaled(2), strip.moment_x(last_frame)));
  if (high > low) list.AddRectFilled({low, top_y}, {high, bottom_y}, shade);
}

void draw_level(ImDrawList& list, const TimelineStrip& strip, float y, ImU32 shade) {
  list.AddRectFilled({strip.left(), std::floor(y)}, {strip.right(), std::floor(y) + 1}, shade);
}

void draw_polylines(ImDrawList& list, const std::vector<Polyline>& lines, ImU32 shade) {
  const float thickness = std::max(1.5F, scaled(1.5));
  std::vector<ImVec2> points;
  for (const Polyline& line : lines) {
    points.clear();
    for (const glm::vec2 point : line) points.emplace_back(point.x, point.y);
    list.AddPolyline(points.data(), static_cast<int>(points.size()), shade, ImDrawFlags_None, thickness);
    if (points.size() == 1) list.AddCircleFilled(points.front(), thickness, shade, 8);
  }
}

void draw_dot(ImDrawList& list, ImVec2 center, ImU32 shade) {
  list.AddCircleFilled(center, scaled(3.5), color::kPanel, 10);
  list.AddCircleFilled(center, scaled(2.5), shade, 10);
}

std::string flags_text(const Survey& survey, double frame, std::optional<FlightFault> fault) {
  std::string text;
  for (const FlightFlag& flag : survey.flags)
    if ((!fault || flag.fault == *fault) && frame >= flag.first_frame - 1 && frame <= flag.last_frame + 1)
      text.append(text.empty() ? "" : "\n").append(flag.text());
  return text;
}

void draw_lane_marks(ImDrawList& list, const LaneMarks& marks) {
  if (marks.survey == nullptr || (marks.style.is_of_encounter() && !marks.survey->encounter))
    return draw_label(list, marks, marks.strip.left(), marks.top_y + marks.height / 2, color::kQuiet, "not known yet");
  if (marks.style.is_strip()) return draw_strip(list, marks);
  draw_flags(list, marks);
  if (marks.style.is_of_encounter()) draw_encounter(list, marks);
  draw_curve(list, marks);
  if (marks.style.lane == Lane::distance) draw_closest(list, marks);
}

void draw_value_dot(ImDrawList& list, const LaneMarks& marks, int frame) {
  const std::optional<double> value = value_at(marks, frame);
  if (!value) return;
  draw_dot(list, {marks.strip.moment_x(frame), y_of(marks, *value)}, marks.style.color);
}

std::string lane_text_at(const LaneMarks& marks, int frame) {
  if (marks.survey == nullptr || frame < marks.survey->first_frame) return "-";
  return text_in(*marks.survey, marks.style.lane, static_cast<std::size_t>(frame - marks.survey->first_frame));
}

void draw_hover(ImDrawList& list, const LaneMarks& marks, int frame) {
  const std::string text = lane_text_at(marks, frame);
  if (text == "-") return;
  const float x = std::floor(marks.strip.moment_x(frame));
  list.AddRectFilled({x, marks.top_y}, {x + 1, marks.top_y + marks.height}, faded(color::kText, 0.5));
  draw_value_dot(list, marks, frame);
  draw_label(list, marks, x, marks.top_y + marks.height / 2, color::kText, fmt::format("{} at {}", text, frame));
}

void draw_offset(ImDrawList& list, const ViewContext& context, const LaneMarks& marks) {
  const ImVec2 mouse = ImGui::GetMousePos();
  if (mouse.y < marks.top_y || mouse.y >= marks.top_y + marks.height) return;
  draw_label(list, marks, mouse.x + scaled(8), marks.top_y + marks.height / 2, color::kAccent,
             fmt::format("offset {:.3f} s", context.project().camera.track.offset_s));
}

void tooltip_for_lanes(const ViewContext& context, const LaneMarks& marks, int frame) {
  const auto index = index_of(marks, frame, marks.survey == nullptr ? 0 : marks.survey->estimates.size());
  if (!index || !item_wants_tooltip()) return;
  const std::string flags = flags_at(marks, frame);
  const bool is_strip = marks.style.is_strip();
  // Over a curve its value stands beside the mouse already.
  if (!is_strip && flags.empty()) return;
  ImGui::BeginTooltip();
  if (is_strip) {
    ImGui::Text("frame %d   %s", frame, time_text_of(context, frame).c_str());
    if (marks.style.lane == Lane::clear && marks.survey->encounter) tell_encounter(marks, frame);
    list_values(*marks.survey, *index);
  }
  if (!flags.empty()) ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(color::kBad), "%s", flags.c_str());
  if (is_strip) {
    ImGui::Separator();
    list_colors(marks.style.lane);
  }
  ImGui::EndTooltip();
}

}  // namespace sigs::editor
