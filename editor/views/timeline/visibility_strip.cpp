// SPDX-License-Identifier: MIT
#include "editor/views/timeline/visibility_strip.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/views/timeline/lane_values.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

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

}  // namespace sigs::editor
