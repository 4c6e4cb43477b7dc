// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lanes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "editor/views/timeline/clear_strip.h"
#include "editor/views/timeline/lane_marks.h"
#include "editor/views/timeline/lane_names.h"
#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/ruler.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

// One lane on the screen.
struct LaneRows::Row {
  const TimelineStrip& strip;
  const LaneState& lane;
  float top_y = 0;
  float height = 0;
};

namespace {

constexpr double kMinCurve_px = 29;
constexpr double kMaxCurve_px = 96;
constexpr float kErrorsShare = 1.7F;  // of a curve's height: several curves, and bars below them

float strip_height() {
  return std::ceil(font(Font::small)->FontSize + scaled(5));
}

LaneGroup group_of(Lane lane) {
  return is_of_camera(lane) ? LaneGroup::camera : LaneGroup::intruder;
}

// "timeline/mark/entry": the first one of each kind.
void note_marks(const ViewContext& context, const TimelineStrip& strip, const std::vector<EncounterMark>& marks) {
  if (!context.ui_probe.wanted()) return;
  constexpr std::array<const char*, 3> kNames{"entry", "exit", "closest"};
  const double middle_y = (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y) / 2.0;
  for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark) {
    const glm::dvec2 at{strip.moment_x(mark->frame), middle_y};
    if (strip.shows(mark->frame))
      context.ui_probe.note(fmt::format("timeline/mark/{}", kNames[static_cast<std::size_t>(mark->kind)]),
                            {at - 3.0, at + 3.0});
  }
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

LaneRows::LaneRows() {
  for (const LaneStyle& style : lane_styles()) lanes_.push_back({.style = style});
}

void LaneRows::refresh(std::shared_ptr<const Survey> survey) {
  if (survey == survey_) return;
  survey_ = std::move(survey);
  for (LaneState& lane : lanes_) lane.values = survey_ ? values_of(*survey_, lane.style.lane) : LaneValues();
}

bool LaneRows::shows_errors(const ViewContext& context) const {
  return shows_errors_ && ErrorLane::has_any(context) && !(camera_turns_ && groups_.is_folded(LaneGroup::intruder));
}

void LaneRows::draw_chooser(const ViewContext& context) {
  if (icon_button("lanes", Icon::settings, "choose the lanes below")) ImGui::OpenPopup("choose lanes");
  context.ui_probe.note_item("timeline/lanes");
  if (!ImGui::BeginPopup("choose lanes")) return;
  const auto draw_choice = [&](const char* title, bool& is_shown) {
    ImGui::Checkbox(title, &is_shown);
    context.ui_probe.note_item(fmt::format("timeline/lanes/{}", title));
  };
  if (ErrorLane::has_any(context)) draw_choice(ErrorLane::kTitle, shows_errors_);
  for (LaneState& lane : lanes_)
    if (camera_turns_ || !is_of_camera(lane.style.lane)) {
      bool shown = is_shown(lane);
      draw_choice(lane.style.title, shown);
      if (shown != is_shown(lane)) lane.is_chosen = shown;
    }
  ImGui::EndPopup();
}

bool LaneRows::is_shown(const LaneState& lane) const {
  const bool is_asked_for = lane.style.lane != Lane::clear || names_volumes_;
  return lane.is_chosen.value_or(lane.style.shown_by_default && is_asked_for);
}

bool LaneRows::is_drawn(const LaneState& lane) const {
  if (!camera_turns_) return is_shown(lane) && !is_of_camera(lane.style.lane);
  return is_shown(lane) && !groups_.is_folded(group_of(lane.style.lane));
}

float LaneRows::curve_height(float room_px, bool with_errors) const {
  float shares = with_errors ? kErrorsShare : 0;
  float for_curves = room_px - (camera_turns_ ? kLaneGroups * LaneGroups::height() : 0);
  for (const LaneState& lane : lanes_) {
    if (!is_drawn(lane)) continue;
    if (lane.style.kind == LaneKind::strip)
      for_curves -= strip_height();
    else
      shares += 1;
  }
  if (shares == 0) return 0;
  return std::floor(std::clamp(for_curves / shares, scaled(kMinCurve_px), scaled(kMaxCurve_px)));
}

// A press on a mark goes to its frame, and is nothing else until it is let go.
bool LaneRows::jumps_to_mark(const ViewContext& context, const TimelineStrip& strip) {
  if (!ImGui::IsItemActive()) has_jumped_ = false;
  if (has_jumped_) return true;
  if (!survey_ || !survey_->encounter) return false;
  const std::vector<EncounterMark> all = encounter_marks(*survey_->encounter);
  note_marks(context, strip, all);
  if (!ImGui::IsItemHovered()) return false;
  const EncounterMark* const mark = mark_at(all, strip, static_cast<double>(ImGui::GetMousePos().x));
  if (mark == nullptr) return false;
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (!ImGui::IsItemActivated()) return false;
  go_by_hand(context, mark->go_to);
  has_jumped_ = true;
  return true;
}

void LaneRows::draw_lane(const ViewContext& context, const Row& row, RulerRow& ruler) {
  const ImVec2 low{row.strip.left(), row.top_y};
  const ImVec2 high{row.strip.right(), row.top_y + row.height};
  const LaneStyle& style = row.lane.style;
  ImGui::SetCursorScreenPos({row.strip.names_x, row.top_y});
  ImGui::Dummy({row.strip.names_width, row.height});
  tooltip_for_item(style.help);
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("lane", {std::max(1.0F, high.x - low.x), row.height});
  context.ui_probe.note_item(fmt::format("timeline/lane/{}", style.title));
  const bool is_taken = is_of_camera(style.lane) ? offset_.update_on_item(context, row.strip)
                                                 : style.lane == Lane::clear && jumps_to_mark(context, row.strip);
  if (!is_taken) ruler.scrub_on_item(context, row.strip);
  const bool hovered = ImGui::IsItemHovered() && !ImGui::IsItemActive();

  const LaneMarks marks{.strip = row.strip,
                        .style = style,
                        .values = row.lane.values,
                        .survey = survey_.get(),
                        .top_y = row.top_y,
                        .height = row.height - 1};
  const int playhead = context.document.playhead();
  draw_lane_names(row.strip, style.title, {row.strip.names_x, row.top_y}, row.height, lane_text_at(marks, playhead),
                  extent_text(style.lane, row.lane.values));
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
  if (is_of_camera(style.lane) && offset_.is_active()) draw_offset(list, context, marks);
  list.PopClipRect();
  draw_row_line(list, row.strip, high.y - 1);
}

float LaneRows::height_of(LaneGroup group, float curve, bool with_errors) const {
  float height = with_errors && group == LaneGroup::intruder ? std::floor(curve * kErrorsShare) : 0;
  for (const LaneState& lane : lanes_)
    if (is_drawn(lane) && group_of(lane.style.lane) == group)
      height += lane.style.kind == LaneKind::strip ? strip_height() : curve;
  return height;
}

void LaneRows::draw_group(const ViewContext& context, const TimelineStrip& strip, LaneGroup group, float y, float curve,
                          RulerRow& ruler) {
  if (group == LaneGroup::intruder && shows_errors(context)) {
    const float height = std::floor(curve * kErrorsShare);
    errors_.draw(context, strip, y, height, ruler);
    y += height;
  }
  for (const LaneState& lane : lanes_) {
    if (!is_drawn(lane) || group_of(lane.style.lane) != group) continue;
    const float height = lane.style.kind == LaneKind::strip ? strip_height() : curve;
    ImGui::PushID(lane.style.title);
    draw_lane(context, {.strip = strip, .lane = lane, .top_y = y, .height = height}, ruler);
    ImGui::PopID();
    y += height;
  }
}

void LaneRows::draw(const ViewContext& context, const TimelineStrip& strip, float room_px, RulerRow& ruler) {
  // While the log is shifted, so far that it covers no frame, its lanes stay under the mouse.
  const bool turns = context.shown.scene && !context.shown.scene->draft.scene.motion.attitudes.empty();
  camera_turns_ = turns || offset_.is_active();
  names_volumes_ = !context.project().output.encounter.empty();
  if (current_intruder(context))
    for (const LaneState& lane : lanes_) context.needs.encounters |= is_of_encounter(lane.style.lane) && is_drawn(lane);
  const std::optional<int> intruder = current_intruder(context);
  const auto index = static_cast<std::size_t>(intruder.value_or(0));
  const bool known = intruder && index < context.shown.surveys.size();
  refresh(known ? context.shown.surveys[index] : nullptr);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const bool with_errors = shows_errors(context);
  const float curve = curve_height(room_px, with_errors);
  const float header = camera_turns_ ? LaneGroups::height() : 0;
  const float camera_y = start.y + header + height_of(LaneGroup::intruder, curve, with_errors);
  const float end_y = camera_y + header + height_of(LaneGroup::camera, curve, with_errors);
  if (camera_turns_) groups_.update(context, strip, {start.y, camera_y}, end_y);
  draw_group(context, strip, LaneGroup::intruder, start.y + header, curve, ruler);
  draw_group(context, strip, LaneGroup::camera, camera_y + header, curve, ruler);
  if (camera_turns_) groups_.draw(strip);
  ImGui::SetCursorScreenPos({start.x, end_y});
}

}  // namespace sigs::editor
