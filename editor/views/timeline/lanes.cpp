// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lanes.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/views/timeline/lane_marks.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

// One lane on the screen.
struct LaneRows::Row {
  const TimelineStrip& strip;
  Lane lane = Lane::visibility_state;
  float top_y = 0;
  float height = 0;
};

namespace {

constexpr double kMinCurve_px = 29;
constexpr double kMaxCurve_px = 96;
constexpr float kErrorsShare = 1.7F;  // of a curve's height: several curves, and bars below them

float line_height() {
  return font(Font::small)->FontSize;
}

float strip_height() {
  return std::ceil(line_height() + scaled(5));
}

// Title and value in one line; below, where there is room, what the values come to.
void draw_lane_names(const TimelineStrip& strip, Lane lane, ImVec2 low, float height, const std::string& value,
                     const std::string& extent) {
  ImGui::PushFont(font(Font::small));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float right = strip.names_x + strip.names_width - scaled(8);
  const bool two_lines = !extent.empty() && height >= 2 * line_height() + scaled(2);
  const float text_height = line_height() * (two_lines ? 2 : 1);
  const float y = std::floor(low.y + std::min((height - text_height) / 2, scaled(4)));
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  const std::string title = elided(style_of(lane).title, right - value_width - strip.names_x - scaled(8));
  list.AddText({strip.names_x + scaled(2), y}, color::kQuiet, title.c_str());
  list.AddText({right - value_width, y}, color::kText, value.c_str());
  if (two_lines) {
    const std::string shown = elided(extent, right - strip.names_x);
    list.AddText({strip.names_x + scaled(2), y + line_height()}, faded(color::kQuiet, 0.75), shown.c_str());
  }
  ImGui::PopFont();
}

std::string extent_text(Lane lane, const LaneValues& values) {
  if (values.values.empty()) return {};
  const std::string minimum = value_text(lane, values.minimum);
  const std::string maximum = value_text(lane, values.maximum);
  if (minimum == maximum) return {};
  const std::string unit = minimum.substr(std::min(minimum.size(), minimum.find(' ')));
  return (maximum.ends_with(unit) ? minimum.substr(0, minimum.size() - unit.size()) : minimum) + " .. " + maximum;
}

}  // namespace

void LaneRows::refresh(std::shared_ptr<const Survey> survey) {
  if (survey == survey_) return;
  survey_ = std::move(survey);
  for (int lane = 0; lane < kLanes; ++lane)
    values_[static_cast<std::size_t>(lane)] = survey_ ? values_of(*survey_, static_cast<Lane>(lane)) : LaneValues();
}

bool LaneRows::shows_errors(const ViewContext& context) const {
  return shows_errors_ && ErrorLane::has_any(context);
}

void LaneRows::draw_chooser(const ViewContext& context) {
  if (icon_button("lanes", Icon::settings, "choose the lanes below")) ImGui::OpenPopup("choose lanes");
  if (!ImGui::BeginPopup("choose lanes")) return;
  if (ErrorLane::has_any(context)) ImGui::Checkbox(ErrorLane::kTitle, &shows_errors_);
  for (int lane = 0; lane < kLanes; ++lane)
    ImGui::Checkbox(style_of(static_cast<Lane>(lane)).title, &shown_[static_cast<std::size_t>(lane)]);
  ImGui::EndPopup();
}

float LaneRows::curve_height(float room_px, bool with_errors) const {
  const auto curves = static_cast<float>(std::count(shown_.begin() + 1, shown_.end(), true));
  const float shares = curves + (with_errors ? kErrorsShare : 0);
  const float for_curves = room_px - (shown_[0] ? strip_height() : 0);
  if (shares == 0) return 0;
  return std::floor(std::clamp(for_curves / shares, scaled(kMinCurve_px), scaled(kMaxCurve_px)));
}

void LaneRows::draw_lane(const ViewContext& context, const Row& row, RulerRow& ruler) const {
  const ImVec2 low{row.strip.left(), row.top_y};
  const ImVec2 high{row.strip.right(), row.top_y + row.height};
  const LaneValues& values = values_[static_cast<std::size_t>(row.lane)];
  ImGui::SetCursorScreenPos({row.strip.names_x, row.top_y});
  ImGui::Dummy({row.strip.names_width, row.height});
  tooltip_for_item(style_of(row.lane).help);
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("lane", {std::max(1.0F, high.x - low.x), row.height});
  context.ui_probe.note_item(std::string("timeline/lane/") + style_of(row.lane).title);
  ruler.scrub_on_item(context, row.strip);
  const bool hovered = ImGui::IsItemHovered() && !ImGui::IsItemActive();

  const LaneMarks marks{.strip = row.strip,
                        .lane = row.lane,
                        .survey = survey_.get(),
                        .values = values,
                        .top_y = row.top_y,
                        .height = row.height - 1};
  const int playhead = context.document.playhead();
  draw_lane_names(row.strip, row.lane, {row.strip.names_x, row.top_y}, row.height, lane_text_at(marks, playhead),
                  extent_text(row.lane, values));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(low, high, true);
  draw_lane_marks(list, marks);
  draw_value_dot(list, marks, playhead);
  if (hovered) {
    const int frame =
        row.strip.ruler.nearest_frame(ImGui::GetIO().MousePos.x, 0, std::max(0, context.document.frame_count() - 1));
    draw_hover(list, marks, frame);
    tooltip_for_lanes(context, marks, frame);
  }
  list.PopClipRect();
  draw_row_line(list, row.strip, high.y - 1);
}

void LaneRows::draw(const ViewContext& context, const TimelineStrip& strip, float room_px, RulerRow& ruler) {
  const std::optional<int> intruder = current_intruder(context);
  const auto index = static_cast<std::size_t>(intruder.value_or(0));
  const bool known = intruder && index < context.shown.surveys.size();
  refresh(known ? context.shown.surveys[index] : nullptr);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const bool with_errors = shows_errors(context);
  const float curve = curve_height(room_px, with_errors);
  float y = start.y;
  if (with_errors) {
    const float height = std::floor(curve * kErrorsShare);
    errors_.draw(context, strip, y, height, ruler);
    y += height;
  }
  for (int i = 0; i < kLanes; ++i) {
    if (!shown_[static_cast<std::size_t>(i)]) continue;
    const auto lane = static_cast<Lane>(i);
    const Row row{
        .strip = strip, .lane = lane, .top_y = y, .height = lane == Lane::visibility_state ? strip_height() : curve};
    ImGui::PushID(i);
    draw_lane(context, row, ruler);
    ImGui::PopID();
    y += row.height;
  }
  ImGui::SetCursorScreenPos({start.x, y});
}

}  // namespace sigs::editor
