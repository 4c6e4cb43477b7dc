// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sigs::editor {

namespace {

constexpr std::array<const char*, kLaneGroups> kTitles{"Intruder", "Camera"};

// Share of the rows from first_y to last_y that lies between top_y and bottom_y.
float share_between(float first_y, float last_y, float top_y, float bottom_y) {
  const float common = std::min(last_y, bottom_y) - std::max(first_y, top_y);
  return std::clamp(common / std::max(1.0F, last_y - first_y), 0.0F, 1.0F);
}

void draw_triangle(ImDrawList& list, ImVec2 center, bool is_folded) {
  const float r = scaled(3.5);
  if (is_folded)
    list.AddTriangleFilled({center.x - r * 0.7F, center.y - r}, {center.x + r, center.y},
                           {center.x - r * 0.7F, center.y + r}, color::kQuiet);
  else
    list.AddTriangleFilled({center.x - r, center.y - r * 0.7F}, {center.x + r, center.y - r * 0.7F},
                           {center.x, center.y + r}, color::kQuiet);
}

}  // namespace

float header_y(float natural_y, std::size_t index, std::size_t count, float height, float top_y, float bottom_y) {
  const float highest_y = top_y + static_cast<float>(index) * height;
  const float lowest_y = bottom_y - static_cast<float>(count - index) * height;
  return std::clamp(natural_y, highest_y, std::max(highest_y, lowest_y));
}

float LaneGroups::height() {
  return std::ceil(font(Font::small)->FontSize + scaled(4));
}

void LaneGroups::press(std::size_t group, float share_in_sight) {
  if (folded_[group] || share_in_sight < 0.5F) {
    folded_[group] = false;
    wanted_ = group;
  } else {
    folded_[group] = true;
  }
}

void LaneGroups::update(const ViewContext& context, const TimelineStrip& strip, std::array<float, kLaneGroups> places_y,
                        float end_y) {
  const float top_y = ImGui::GetWindowPos().y;
  const float bottom_y = top_y + ImGui::GetWindowHeight();
  hovered_.reset();
  const ImVec2 cursor = ImGui::GetCursorScreenPos();
  for (std::size_t i = 0; i < kLaneGroups; ++i) {
    shown_y_[i] = header_y(places_y[i], i, kLaneGroups, height(), top_y, bottom_y);
    const float last_y = i + 1 < kLaneGroups ? places_y[i + 1] : end_y;
    // The headers at the edges hide rows.
    const float first_seen_y = top_y + static_cast<float>(i + 1) * height();
    const float last_seen_y = bottom_y - static_cast<float>(kLaneGroups - 1 - i) * height();
    ImGui::SetCursorScreenPos({strip.names_x, shown_y_[i]});
    ImGui::PushID(kTitles[i]);
    if (ImGui::InvisibleButton("group", {strip.right() - strip.names_x, height()}))
      press(i, share_between(places_y[i] + height(), last_y, first_seen_y, last_seen_y));
    ImGui::PopID();
    context.ui_probe.note_item(fmt::format("timeline/group/{}", kTitles[i]));
    if (ImGui::IsItemHovered()) hovered_ = i;
    if (wanted_ == i && !ImGui::IsItemClicked() && !ImGui::IsItemDeactivated()) {
      ImGui::SetScrollY(ImGui::GetScrollY() + places_y[i] - top_y - static_cast<float>(i) * height());
      wanted_.reset();
    }
  }
  ImGui::SetCursorScreenPos(cursor);
}

void LaneGroups::draw(const TimelineStrip& strip) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::PushFont(font(Font::small));
  for (std::size_t i = 0; i < kLaneGroups; ++i) {
    const ImVec2 low{strip.names_x, shown_y_[i]};
    const ImVec2 high{strip.right(), shown_y_[i] + height()};
    list.AddRectFilled(low, high, color::kPanel);
    list.AddRectFilled(low, {high.x, high.y - 1}, faded(color::kText, hovered_ == i ? 0.16 : 0.08));
    draw_triangle(list, {low.x + scaled(7), (low.y + high.y) / 2}, folded_[i]);
    list.AddText({low.x + scaled(16), std::floor(low.y + scaled(2))}, color::kText, kTitles[i]);
  }
  ImGui::PopFont();
}

}  // namespace sigs::editor
