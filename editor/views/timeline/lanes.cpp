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

#include "editor/views/timeline/deviation_band.h"
#include "editor/views/timeline/lane_names.h"
#include "editor/views/timeline/lane_values.h"
#include "editor/views/timeline/ruler.h"
#include "editor/views/timeline/visibility_strip.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

// What is drawn in a lane.
struct LaneMarks {
  const TimelineStrip& strip;
  const LaneStyle& style;
  const LaneValues& values;
  const Survey* survey = nullptr;  // null: not known yet
  float top_y = 0;
  float height = 0;
};

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
    if (!belongs_to(flag.fault, marks.style.lane)) continue;
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

// What all lanes say of a frame.
void list_values(const Survey& survey, std::size_t i) {
  ImGui::BeginTable("values", 2, ImGuiTableFlags_SizingFixedFit);
  for (const LaneStyle& style : lane_styles()) {
    if (is_of_camera(style.lane) && survey.camera.empty()) continue;
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", style.title);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text_in(survey, style.lane, i).c_str());
  }
  ImGui::EndTable();
}

// Over a strip all that is wrong with the flight there, over a curve what belongs to it.
std::string flags_at(const LaneMarks& marks, int frame) {
  std::string text;
  for (const FlightFlag& flag : marks.survey->flags) {
    const bool is_reported_here = marks.style.kind == LaneKind::strip || belongs_to(flag.fault, marks.style.lane);
    if (is_reported_here && frame >= flag.first_frame - 1 && frame <= flag.last_frame + 1)
      text.append(text.empty() ? "" : "\n").append(flag.text());
  }
  return text;
}

// The coloured stretches of a strip.
void draw_strip(ImDrawList& list, const LaneMarks& marks) {
  if (marks.style.lane == Lane::visibility)
    draw_visibility_strip(list, marks.strip, *marks.survey, marks.top_y, marks.height);
}

// What the colours of a strip mean.
void list_colors(Lane lane) {
  if (lane == Lane::visibility) list_visibility_colors();
}

// The strip or the curve; with a curve the closest approach, and in red what no such aircraft could fly.
void draw_lane_marks(ImDrawList& list, const LaneMarks& marks) {
  if (marks.survey == nullptr) {
    draw_label(list, marks, marks.strip.left(), marks.top_y + marks.height / 2, color::kQuiet, "not known yet");
    return;
  }
  if (marks.style.kind == LaneKind::strip) {
    draw_strip(list, marks);
    return;
  }
  draw_flags(list, marks);
  draw_curve(list, marks);
  if (marks.style.lane == Lane::distance) draw_closest(list, marks);
}

void draw_value_dot(ImDrawList& list, const LaneMarks& marks, int frame) {
  const std::optional<double> value = value_at(marks, frame);
  if (!value) return;
  const ImVec2 center{marks.strip.moment_x(frame), y_of(marks, *value)};
  list.AddCircleFilled(center, scaled(3.5), color::kPanel, 10);
  list.AddCircleFilled(center, scaled(2.5), marks.style.color, 10);
}

// The lane's value in words: "933 m", "in view"; "-" where it is not known.
std::string lane_text_at(const LaneMarks& marks, int frame) {
  if (marks.survey == nullptr || frame < marks.survey->first_frame) return "-";
  return text_in(*marks.survey, marks.style.lane, static_cast<std::size_t>(frame - marks.survey->first_frame));
}

// A hair line at the frame below the mouse, with its value.
void draw_hover(ImDrawList& list, const LaneMarks& marks, int frame) {
  const std::string text = lane_text_at(marks, frame);
  if (text == "-") return;
  const float x = std::floor(marks.strip.moment_x(frame));
  list.AddRectFilled({x, marks.top_y}, {x + 1, marks.top_y + marks.height}, faded(color::kText, 0.5));
  draw_value_dot(list, marks, frame);
  draw_label(list, marks, x, marks.top_y + marks.height / 2, color::kText, fmt::format("{} at {}", text, frame));
}

// While the log is shifted: by what, beside the mouse.
void draw_offset(ImDrawList& list, const ViewContext& context, const LaneMarks& marks) {
  const ImVec2 mouse = ImGui::GetMousePos();
  if (mouse.y < marks.top_y || mouse.y >= marks.top_y + marks.height) return;
  draw_label(list, marks, mouse.x + scaled(8), marks.top_y + marks.height / 2, color::kAccent,
             fmt::format("offset {:.3f} s", context.project().camera.track.offset_s));
}

// Once the mouse has rested: over a strip all that is known of a frame and what the colours mean, over a curve why it
// is flagged.
void tooltip_for_lanes(const ViewContext& context, const LaneMarks& marks, int frame) {
  const auto index = index_of(marks, frame, marks.survey == nullptr ? 0 : marks.survey->estimates.size());
  if (!index || !item_wants_tooltip()) return;
  const std::string flags = flags_at(marks, frame);
  const bool is_strip = marks.style.kind == LaneKind::strip;
  // Over a curve its value stands beside the mouse already.
  if (!is_strip && flags.empty()) return;
  ImGui::BeginTooltip();
  if (is_strip) {
    ImGui::Text("frame %d   %s", frame, time_text_of(context, frame).c_str());
    list_values(*marks.survey, *index);
  }
  if (!flags.empty()) ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(color::kBad), "%s", flags.c_str());
  if (is_strip) {
    ImGui::Separator();
    list_colors(marks.style.lane);
  }
  ImGui::EndTooltip();
}

}  // namespace

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
  for (const LaneStyle& style : lane_styles()) lanes_.push_back({.style = style, .is_shown = style.shown_by_default});
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
    if (camera_turns_ || !is_of_camera(lane.style.lane)) draw_choice(lane.style.title, lane.is_shown);
  ImGui::EndPopup();
}

bool LaneRows::is_drawn(const LaneState& lane) const {
  if (!camera_turns_) return lane.is_shown && !is_of_camera(lane.style.lane);
  return lane.is_shown && !groups_.is_folded(group_of(lane.style.lane));
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
  if (!is_of_camera(style.lane) || !offset_.update_on_item(context, row.strip)) ruler.scrub_on_item(context, row.strip);
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
  const bool turns = context.shown.scene && !context.shown.scene->draft.scene.motion.turns.empty();
  camera_turns_ = turns || offset_.is_active();
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
