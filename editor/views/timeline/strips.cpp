// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sigs::editor {

namespace {

constexpr double kMarkReach_px = 6;

// A near mid-air collision is worse than any other loss.
ImU32 color_of_loss(const WellClearVolume& volume) {
  return volume.name == nmac_volume().name ? IM_COL32(255, 60, 110, 255) : color::kBad;
}

struct VolumeBar {
  float top_y = 0;
  float height = 0;
};

VolumeBar bar_of(std::size_t volume, std::size_t count, float top_y, float height) {
  const float inset = scaled(count > 2 ? 2 : 4);
  const float each = (height - 2 * inset) / static_cast<float>(std::max<std::size_t>(1, count));
  const float gap = count > 1 ? 1 : 0;
  return {top_y + inset + each * static_cast<float>(volume), std::max(1.0F, each - gap)};
}

void draw_loss(ImDrawList& list, const TimelineStrip& strip, const LossStretch& loss, const VolumeBar& bar,
               ImU32 shade) {
  draw_stretch(list, strip, loss.first_frame, loss.last_frame, bar.top_y, bar.top_y + bar.height, shade);
}

// An entry is a bracket that opens to the right, an exit one that opens to the left.
void draw_bracket(ImDrawList& list, const TimelineStrip& strip, const EncounterMark& mark, const VolumeBar& bar) {
  const float x = std::floor(strip.moment_x(mark.frame));
  const float side = scaled(4) * (mark.kind == EncounterMark::Kind::entry ? 1.0F : -1.0F);
  const float low = bar.top_y - 1;
  const float high = bar.top_y + bar.height + 1;
  const ImVec2 points[] = {{x + side, low}, {x, low}, {x, high}, {x + side, high}};
  list.AddPolyline(points, 4, color::kText, ImDrawFlags_None, scaled(1.5));
}

void draw_closest_mark(ImDrawList& list, ImVec2 center, float radius) {
  draw_diamond(list, center, radius + scaled(1.5), IM_COL32(0, 0, 0, 170));
  draw_diamond(list, center, radius, color::kPartly);
}

// A line of a tooltip: what is drawn in a square of the font's size, and what it means.
template <class Draw>
void list_mark(const std::string& meaning, const Draw& draw) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetFontSize();
  ImGui::Dummy({side, side});
  draw(*ImGui::GetWindowDrawList(), at, side);
  ImGui::SameLine();
  ImGui::TextDisabled("%s", meaning.c_str());
}

void list_color(const std::string& meaning, ImU32 shade) {
  list_mark(meaning, [shade](ImDrawList& list, ImVec2 at, float side) {
    list.AddRectFilled({at.x, at.y + side * 0.25F}, {at.x + side * 0.8F, at.y + side * 0.85F}, shade);
  });
}

}  // namespace

std::vector<EncounterMark> encounter_marks(const EncounterSurvey& survey) {
  std::vector<EncounterMark> marks;
  if (survey.volumes.empty()) return marks;
  for (std::size_t i = 0; i < survey.volumes.size(); ++i) {
    const std::string& name = survey.volumes[i].volume.name;
    for (const LossStretch& loss : survey.volumes[i].losses) {
      if (loss.has_entry)
        marks.push_back({EncounterMark::Kind::entry, loss.first_frame, loss.entry_frame(), i,
                         fmt::format("well clear lost ({}) at {:.3f} s", name, loss.time_s.begin_s)});
      if (loss.has_exit)
        marks.push_back({EncounterMark::Kind::exit, loss.last_frame, loss.exit_frame(), i,
                         fmt::format("well clear again ({}) at {:.3f} s", name, loss.time_s.end_s)});
    }
  }
  marks.push_back({EncounterMark::Kind::closest, survey.nearest_frame,
                   static_cast<int>(std::lround(std::clamp(survey.nearest_frame, -1e9, 1e9))), 0,
                   fmt::format("closest approach at {:.3f} s: {:.1f} m beside, {:.1f} m {}", survey.nearest.time_s,
                               survey.nearest.horizontal_m, std::abs(survey.nearest.vertical_m),
                               survey.nearest.vertical_m < 0 ? "below" : "above")});
  std::ranges::stable_sort(marks, {}, &EncounterMark::frame);
  return marks;
}

const EncounterMark* mark_at(const std::vector<EncounterMark>& marks, const TimelineStrip& strip, double x) {
  const EncounterMark* nearest = nullptr;
  double nearest_px = scaled(kMarkReach_px);
  for (const EncounterMark& mark : marks) {
    const double apart_px = std::abs(static_cast<double>(strip.moment_x(mark.frame)) - x);
    if (!strip.shows(mark.frame) || apart_px > nearest_px) continue;
    nearest_px = apart_px;
    nearest = &mark;
  }
  return nearest;
}

void draw_clear_strip(ImDrawList& list, const TimelineStrip& strip, const EncounterSurvey& survey, float top_y,
                      float height) {
  const std::size_t count = survey.volumes.size();
  const auto frames = static_cast<double>(survey.horizontal_range_m.size());
  const LossStretch whole{.first_frame = static_cast<double>(survey.first_frame),
                          .last_frame = survey.first_frame + frames - 1};
  for (std::size_t i = 0; i < count; ++i) {
    const VolumeBar bar = bar_of(i, count, top_y, height);
    draw_loss(list, strip, whole, bar, faded(color::kGood, 0.35));
    const ImU32 shade = color_of_loss(survey.volumes[i].volume);
    for (const LossStretch& loss : survey.volumes[i].losses) draw_loss(list, strip, loss, bar, faded(shade, 0.9));
  }
  for (const EncounterMark& mark : encounter_marks(survey)) {
    if (!strip.shows(mark.frame)) continue;
    if (mark.kind == EncounterMark::Kind::closest)
      draw_closest_mark(list, {strip.moment_x(mark.frame), std::floor(top_y + height / 2)}, scaled(4.5));
    else
      draw_bracket(list, strip, mark, bar_of(mark.volume, count, top_y, height));
  }
}

const char* clear_text(const EncounterSurvey& survey, int frame) {
  for (std::size_t i = 0; i < survey.volumes.size(); ++i)
    if (survey.is_lost(i, frame)) return "lost";
  return survey.volumes.empty() ? "-" : "clear";
}

std::string clear_lines(const EncounterSurvey& survey, int frame) {
  std::string lines;
  for (std::size_t i = 0; i < survey.volumes.size(); ++i)
    lines += fmt::format("{}{}: {}", i > 0 ? "\n" : "", survey.volumes[i].volume.name,
                         survey.is_lost(i, frame) ? "lost" : "clear");
  return lines;
}

void list_clear_colors() {
  list_color("well clear", faded(color::kGood, 0.35));
  list_color("lost; a bracket at entry and exit", faded(color::kBad, 0.9));
  list_mark("closest approach", [](ImDrawList& list, ImVec2 at, float side) {
    draw_closest_mark(list, {at.x + side * 0.4F, at.y + side * 0.55F}, scaled(4));
  });
  ImGui::TextDisabled("A click on a mark goes to its frame.");
}

void draw_loss_ground(ImDrawList& list, const TimelineStrip& strip, const EncounterSurvey& survey, float top_y,
                      float height) {
  if (survey.volumes.empty()) return;
  for (const LossStretch& loss : survey.volumes.front().losses)
    draw_loss(list, strip, loss, {top_y, height}, faded(color::kBad, 0.16));
}

ImU32 color_of(VisibilityState visibility_state) {
  switch (visibility_state) {
    case VisibilityState::in_view:
      return color::kGood;
    case VisibilityState::partly_occluded:
      return color::kPartly;
    case VisibilityState::occluded:
      return faded(color::kOwnBody, 1);
    case VisibilityState::out_of_view:
      return IM_COL32(84, 88, 98, 255);
  }
  return color::kQuiet;
}

void draw_visibility_strip(ImDrawList& list, const TimelineStrip& strip, const Survey& survey, float top_y,
                           float height) {
  const std::vector<VisibilityEstimate>& estimates = survey.estimates;
  const TimeRuler& ruler = strip.ruler;
  const auto size = static_cast<double>(estimates.size());
  const double first = survey.first_frame;
  const auto from = static_cast<std::size_t>(std::clamp(std::floor(ruler.first) - first, 0.0, size));
  const auto to = static_cast<std::size_t>(std::clamp(std::ceil(ruler.first + ruler.count) - first, 0.0, size));
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(ruler.count / std::max(1.0, ruler.width))));
  const float inset = scaled(4);
  for (std::size_t i = from; i < to;) {
    std::size_t end = i + stride;
    while (end < to && estimates[end].visibility_state == estimates[i].visibility_state) end += stride;
    end = std::min(end, to);
    list.AddRectFilled({strip.edge_x(first + static_cast<double>(i)), top_y + inset},
                       {strip.edge_x(first + static_cast<double>(end)), top_y + height - inset},
                       faded(color_of(estimates[i].visibility_state), 0.85));
    i = end;
  }
}

void list_visibility_colors() {
  for (const VisibilityState visibility_state : {VisibilityState::in_view, VisibilityState::partly_occluded,
                                                 VisibilityState::occluded, VisibilityState::out_of_view}) {
    const bool is_hidden =
        visibility_state == VisibilityState::partly_occluded || visibility_state == VisibilityState::occluded;
    list_color(name_of(visibility_state) + std::string(is_hidden ? " by the own body" : ""),
               color_of(visibility_state));
  }
}

}  // namespace sigs::editor
