// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/document/field_edits.h"
#include "editor/views/timeline/lanes.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

void draw_lane_names(const TimelineStrip& strip, const char* title, ImVec2 low, float height, const std::string& value,
                     const std::string& extent) {
  ImGui::PushFont(font(Font::small));
  const float line = font(Font::small)->FontSize;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float right = strip.names_x + strip.names_width - scaled(8);
  const bool two_lines = !extent.empty() && height >= 2 * line + scaled(2);
  const float text_height = line * (two_lines ? 2 : 1);
  const float y = std::floor(low.y + std::min((height - text_height) / 2, scaled(4)));
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  const std::string shown_title = elided(title, right - value_width - strip.names_x - scaled(8));
  list.AddText({strip.names_x + scaled(2), y}, color::kQuiet, shown_title.c_str());
  list.AddText({right - value_width, y}, color::kText, value.c_str());
  if (two_lines) {
    const std::string shown = elided(extent, right - strip.names_x);
    list.AddText({strip.names_x + scaled(2), y + line}, faded(color::kQuiet, 0.75), shown.c_str());
  }
  ImGui::PopFont();
}

namespace {

constexpr const char* kKey = "camera.track.offset_s";

glm::dvec2 mouse() {
  return {ImGui::GetMousePos().x, ImGui::GetMousePos().y};
}

constexpr double kMinCurve_px = 29;
constexpr double kMaxCurve_px = 96;
constexpr float kErrorsShare = 1.7F;  // of a curve's height: several curves, and bars below them

float strip_height() {
  return std::ceil(font(Font::small)->FontSize + scaled(5));
}

LaneGroup group_of(const LaneStyle& style) {
  return style.is_of_camera() ? LaneGroup::camera : LaneGroup::intruder;
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

bool OffsetDrag::update_on_item(const ViewContext& context, const TimelineStrip& strip) {
  const unsigned int item = ImGui::GetID("lane");
  if (held_ && held_->item != item) return false;
  const bool may_begin = !context.project().camera.track.file.empty() && ImGui::GetIO().KeyAlt;
  if (!held_ && may_begin && ImGui::IsItemActivated())
    held_ = Held{.item = item,
                 .offset_before_s = context.project().camera.track.offset_s,
                 .gesture = drag_gesture_at(context, mouse(), fmt::format("log offset {}", ++gestures_))};
  if (held_ || (may_begin && ImGui::IsItemHovered())) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (!held_) return false;
  if (!ImGui::IsItemActive()) {
    if (!held_->is_over) held_->gesture.end(context);
    held_.reset();
  } else if (!held_->is_over) {
    drag(context, strip);
  }
  return true;
}

// The curve goes with the mouse: what was at the press is at the mouse's moment, so the log's time there is earlier.
void OffsetDrag::drag(const ViewContext& context, const TimelineStrip& strip) {
  DragGesture& gesture = held_->gesture;
  if (gesture.is_lost(context) || gesture.cancelled_by_key(context)) {
    held_->is_over = true;
    return;
  }
  gesture.is_moving = gesture.is_moving || gesture.has_left_press(mouse());
  if (!gesture.is_moving) return;
  const double by_s =
      time_of(context, strip.moment_at(mouse().x)) - time_of(context, strip.moment_at(gesture.pressed.x));
  const double offset_s = std::round((held_->offset_before_s - by_s) * 1000) / 1000;
  context.edits.change(
      "shift log in time", [offset_s](Project& project) { put_value(project, kKey, offset_s); }, gesture.name);
}

// One lane on the screen.
struct LaneRows::Row {
  const TimelineStrip& strip;
  const LaneState& lane;
  float top_y = 0;
  float height = 0;
  const Survey* survey = nullptr;
  std::string camera = {};  // whose visibility it shows; "": that of the only one
};

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
  if (context.ui_probe.noted(icon_button("lanes", Icon::settings, "choose the lanes below"), "timeline/lanes"))
    ImGui::OpenPopup("choose lanes");
  if (!ImGui::BeginPopup("choose lanes")) return;
  const auto draw_choice = [&](const char* title, bool& is_shown) {
    ImGui::Checkbox(title, &is_shown);
    context.ui_probe.note_item(fmt::format("timeline/lanes/{}", title));
  };
  if (ErrorLane::has_any(context)) draw_choice(ErrorLane::kTitle, shows_errors_);
  for (LaneState& lane : lanes_)
    if (camera_turns_ || !lane.style.is_of_camera()) {
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
  if (!camera_turns_) return is_shown(lane) && !lane.style.is_of_camera();
  return is_shown(lane) && !groups_.is_folded(group_of(lane.style));
}

std::size_t LaneRows::rows_of(const LaneState& lane) const {
  return lane.style.lane == Lane::visibility ? cameras_ : 1;
}

float LaneRows::curve_height(float room_px, bool with_errors) const {
  float shares = with_errors ? kErrorsShare : 0;
  float for_curves = room_px - (camera_turns_ ? kLaneGroups * LaneGroups::height() : 0);
  for (const LaneState& lane : lanes_) {
    if (!is_drawn(lane)) continue;
    if (lane.style.is_strip())
      for_curves -= strip_height() * static_cast<float>(rows_of(lane));
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
  tooltip_for_item(row.camera.empty() ? style.help : ("What " + row.camera + " sees of it").c_str());
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("lane", {std::max(1.0F, high.x - low.x), row.height});
  context.ui_probe.note_item(fmt::format("timeline/lane/{}", row.camera.empty() ? style.title : row.camera));
  const bool is_taken = style.is_of_camera() ? offset_.update_on_item(context, row.strip)
                                             : style.lane == Lane::clear && jumps_to_mark(context, row.strip);
  if (!is_taken) ruler.scrub_on_item(context, row.strip);
  const bool hovered = ImGui::IsItemHovered() && !ImGui::IsItemActive();

  const LaneMarks marks{.strip = row.strip,
                        .style = style,
                        .values = row.lane.values,
                        .survey = row.survey,
                        .top_y = row.top_y,
                        .height = row.height - 1};
  const int playhead = context.document.playhead();
  draw_lane_names(row.strip, row.camera.empty() ? style.title : row.camera.c_str(), {row.strip.names_x, row.top_y},
                  row.height, lane_text_at(marks, playhead), extent_text(style.lane, row.lane.values));
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
  if (style.is_of_camera() && offset_.is_active()) draw_offset(list, context, marks);
  list.PopClipRect();
  draw_row_line(list, row.strip, high.y - 1);
}

float LaneRows::height_of(LaneGroup group, float curve, bool with_errors) const {
  float height = with_errors && group == LaneGroup::intruder ? std::floor(curve * kErrorsShare) : 0;
  for (const LaneState& lane : lanes_)
    if (is_drawn(lane) && group_of(lane.style) == group)
      height += lane.style.is_strip() ? strip_height() * static_cast<float>(rows_of(lane)) : curve;
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
    if (!is_drawn(lane) || group_of(lane.style) != group) continue;
    const float height = lane.style.is_strip() ? strip_height() : curve;
    ImGui::PushID(lane.style.title);
    for (std::size_t i = 0; i < rows_of(lane); ++i) {
      const bool is_of_rig = rows_of(lane) > 1;
      const std::shared_ptr<const Survey> survey =
          is_of_rig ? survey_of(seen_from(context, i), current_intruder(context).value_or(-1)) : survey_;
      ImGui::PushID(static_cast<int>(i));
      draw_lane(context,
                {.strip = strip,
                 .lane = lane,
                 .top_y = y,
                 .height = height,
                 .survey = survey.get(),
                 .camera = is_of_rig ? context.document.cameras()[i].name : std::string()},
                ruler);
      ImGui::PopID();
      y += height;
    }
    ImGui::PopID();
  }
}

void LaneRows::draw(const ViewContext& context, const TimelineStrip& strip, float room_px, RulerRow& ruler) {
  // While the log is shifted, so far that it covers no frame, its lanes stay under the mouse.
  const bool turns = context.shown.scene && !context.shown.scene->draft.scene.motion.attitudes.empty();
  camera_turns_ = turns || offset_.is_active();
  cameras_ = context.rig != nullptr ? std::max<std::size_t>(1, context.rig->size()) : 1;
  names_volumes_ = !context.project().output.encounter.empty();
  if (current_intruder(context))
    for (const LaneState& lane : lanes_) context.needs.encounters |= lane.style.is_of_encounter() && is_drawn(lane);
  refresh(survey_of(context, current_intruder(context).value_or(-1)));
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
