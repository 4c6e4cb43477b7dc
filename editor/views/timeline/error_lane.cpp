// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "editor/views/timeline/lanes.h"

namespace sigs::editor {

namespace {

constexpr double kMinSpan_px = 4;

ErrorCurve curve_of_tracker(const ScoredTracker& tracker, int first_frame) {
  ErrorCurve curve{.color = tracker.file.color};
  const auto count = static_cast<int>(tracker.score->frames.size());
  for (int i = 0; i < count; ++i) {
    const int frame = first_frame + i;
    const FrameScore& score = tracker.score->frames[static_cast<std::size_t>(i)];
    const bool counts = score.is_scored && score.center_error_px;
    curve.errors_px.push_back(counts ? *score.center_error_px : std::numeric_limits<double>::quiet_NaN());
    const TrackerMoment moment = moment_of(tracker, first_frame, frame);
    if (moment != TrackerMoment::lost && moment != TrackerMoment::silent) continue;
    const bool goes_on =
        !curve.lost.empty() && curve.lost.back().last_frame == frame - 1 && curve.lost.back().moment == moment;
    if (goes_on)
      curve.lost.back().last_frame = frame;
    else
      curve.lost.push_back({frame, frame, moment});
  }
  return curve;
}

constexpr double kPrecision_px = 20;  // the threshold that precision is usually told at
constexpr const char* kHelp =
    "From the middle of the truth's box to that of each tracker's. Gaps: nothing to compare. Bars below: "
    "the target is lost; thin ones: nothing is reported. The line: 20 px. Small errors take more room than large ones";

// Where the parts of the lane lie.
struct LaneParts {
  const TimelineStrip& strip;
  float top_y = 0;
  float height = 0;
  float bar = 0;  // height of one tracker's bars
  LaneBox curves;
};

LaneParts parts_of(const TimelineStrip& strip, float top_y, float height, std::size_t trackers) {
  const auto count = static_cast<float>(std::max<std::size_t>(1, trackers));
  const float bar = std::floor(std::clamp(height * 0.3F / count, 2.0F, scaled(4)));
  const float inset = scaled(3);
  return {.strip = strip,
          .top_y = top_y,
          .height = height,
          .bar = bar,
          .curves = {.top_y = top_y + inset, .height = std::max(1.0F, height - 2 * inset - bar * count)}};
}

float y_of(const LaneParts& parts, const LaneScale& scale, double error_px) {
  return static_cast<float>(parts.curves.top_y + (1 - scale.share_of(error_px)) * parts.curves.height);
}

void draw_curve(ImDrawList& list, const LaneParts& parts, const ErrorCurves& all, const ErrorCurve& curve) {
  draw_polylines(list, curve_of(curve.errors_px, all.first_frame, parts.strip.ruler, all.scale, parts.curves),
                 result_color(curve.color));
}

// Of one tracker, from y down. Nothing reported: a thin line; lost: the whole height.
void draw_bars(ImDrawList& list, const LaneParts& parts, const ErrorCurve& curve, float y) {
  const float gap = parts.bar > 2 ? 1 : 0;
  for (const LostStretch& stretch : curve.lost) {
    const float low = std::max(parts.strip.left(), parts.strip.edge_x(stretch.first_frame));
    const float high = std::min(parts.strip.right(), std::max(low + 1, parts.strip.edge_x(stretch.last_frame + 1)));
    if (high <= low) continue;
    const bool lost = stretch.moment == TrackerMoment::lost;
    const float top = lost ? y : std::floor(y + (parts.bar - gap) / 2);
    list.AddRectFilled({low, top}, {high, lost ? y + parts.bar - gap : top + 1},
                       faded(result_color(curve.color), lost ? 0.9 : 0.65));
  }
}

void draw_curves(ImDrawList& list, const LaneParts& parts, const ErrorCurves& all) {
  if (kPrecision_px < all.scale.high)
    draw_level(list, parts.strip, y_of(parts, all.scale, kPrecision_px), faded(color::kText, 0.18));
  float y = parts.top_y + parts.height - parts.bar * static_cast<float>(all.curves.size());
  for (const ErrorCurve& curve : all.curves) {
    draw_bars(list, parts, curve, y);
    y += parts.bar;
  }
  for (const ErrorCurve& curve : all.curves) draw_curve(list, parts, all, curve);
}

void draw_dots(ImDrawList& list, const LaneParts& parts, const ErrorCurves& all, int frame) {
  for (const ErrorCurve& curve : all.curves) {
    const auto index = static_cast<std::size_t>(frame - all.first_frame);
    if (frame < all.first_frame || index >= curve.errors_px.size() || !std::isfinite(curve.errors_px[index])) continue;
    draw_dot(list, {parts.strip.moment_x(frame), y_of(parts, all.scale, curve.errors_px[index])},
             result_color(curve.color));
  }
}

void cell(const std::string& text, ImU32 shade) {
  ImGui::TableNextColumn();
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (room > 0 && ImGui::TableGetColumnIndex() > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(shade), "%s", text.c_str());
}

void list_tracker(const Scored& scored, const ScoredTracker& tracker, int frame) {
  const FrameScore* const score = score_at(tracker, scored.first_frame, frame);
  ImGui::TableNextRow();
  cell(shown_name(scored, tracker), result_color(tracker.file.color));
  cell(moment_text(tracker, scored.first_frame, frame), color::kText);
  const bool has_error = score != nullptr && score->dx_px && score->dy_px;
  cell(has_error ? signed_text(*score->dx_px) : "-", color::kText);
  cell(has_error ? signed_text(*score->dy_px) : "-", color::kText);
  cell(score != nullptr && score->is_scored ? percent_text(score->overlap) : "-", color::kText);
}

void tooltip_at(const ViewContext& context, int frame) {
  const Scored& scored = *context.scored;
  ImGui::BeginTooltip();
  ImGui::Text("frame %d   %s", frame, time_text_of(context, frame).c_str());
  if (ImGui::BeginTable("errors", 5, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableNextRow();
    for (const char* const title : {"", "error", "dx px", "dy px", "overlap"}) cell(title, color::kQuiet);
    for (const ScoredTracker& tracker : scored.trackers)
      if (tracker.file.is_shown && tracker.results) list_tracker(scored, tracker, frame);
    ImGui::EndTable();
  }
  if (scored.truth != TruthKind::measured) ImGui::TextDisabled("about: by its outline, not measured yet");
  ImGui::EndTooltip();
}

}  // namespace

ErrorCurves error_curves(const Scored& scored) {
  ErrorCurves result{.first_frame = scored.first_frame};
  std::vector<double> all;
  for (const ScoredTracker& tracker : scored.trackers) {
    if (!tracker.file.is_shown || !tracker.score) continue;
    result.curves.push_back(curve_of_tracker(tracker, scored.first_frame));
    const std::vector<double>& errors_px = result.curves.back().errors_px;
    all.insert(all.end(), errors_px.begin(), errors_px.end());
  }
  for (const double error_px : all)
    if (std::isfinite(error_px)) result.max_px = std::max(result.max_px, error_px);
  // From 0 in any case: how far a curve lies above the ground is what is read.
  all.push_back(0);
  result.scale = scale_for(all, kMinSpan_px, Scaling::logarithmic);
  return result;
}

void ErrorLane::refresh(const Scored& scored) {
  std::vector<Drawn> present;
  for (const ScoredTracker& tracker : scored.trackers) present.push_back({tracker.score, tracker.file});
  if (present == drawn_ && curves_.first_frame == scored.first_frame) return;
  drawn_ = std::move(present);
  curves_ = error_curves(scored);
}

// The title with the largest error, then as many trackers as have room, each with its error at the playhead.
void ErrorLane::draw_names(const Scored& scored, const TimelineStrip& strip, float top_y, float height,
                           int frame) const {
  ImGui::PushFont(font(Font::small));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetFontSize();
  const float left = strip.names_x + scaled(2);
  const float right = strip.names_x + strip.names_width - scaled(8);
  float y = std::floor(top_y + scaled(4));
  const auto draw_line = [&](const std::string& name, ImU32 name_color, const std::string& value, ImU32 value_color) {
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    list.AddText({left, y}, name_color, elided(name, right - width - left - scaled(6)).c_str());
    list.AddText({right - width, y}, value_color, value.c_str());
    y += line;
  };
  const std::string maximum = curves_.max_px > 0 ? "0 .. " + pixels_text(curves_.max_px) : "";
  draw_line(kTitle, color::kQuiet, maximum, faded(color::kQuiet, 0.75));
  for (const ScoredTracker& tracker : scored.trackers) {
    if (!tracker.file.is_shown || !tracker.results) continue;
    if (y + line > top_y + height) break;
    draw_line(shown_name(scored, tracker), result_color(tracker.file.color),
              moment_text(tracker, scored.first_frame, frame), color::kText);
  }
  ImGui::PopFont();
}

void ErrorLane::draw(const ViewContext& context, const TimelineStrip& strip, float top_y, float height,
                     RulerRow& ruler) {
  const Scored& scored = *context.scored;
  refresh(scored);
  ImGui::PushID("errors");
  ImGui::SetCursorScreenPos({strip.names_x, top_y});
  ImGui::Dummy({strip.names_width, height});
  tooltip_for_item(kHelp);
  ImGui::SetCursorScreenPos({strip.left(), top_y});
  ImGui::InvisibleButton("lane", {std::max(1.0F, strip.right() - strip.left()), height});
  context.ui_probe.note_item(fmt::format("timeline/lane/{}", kTitle));
  ruler.scrub_on_item(context, strip);
  const bool hovered = ImGui::IsItemHovered() && !ImGui::IsItemActive();

  const int playhead = context.document.playhead();
  draw_names(scored, strip, top_y, height, playhead);
  const LaneParts parts = parts_of(strip, top_y, height - 1, curves_.curves.size());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect({strip.left(), top_y}, {strip.right(), top_y + height}, true);
  draw_curves(list, parts, curves_);
  draw_dots(list, parts, curves_, playhead);
  if (hovered) {
    const int frame =
        strip.ruler.nearest_frame(ImGui::GetIO().MousePos.x, 0, std::max(0, context.document.frame_count() - 1));
    const float x = std::floor(strip.moment_x(frame));
    list.AddRectFilled({x, top_y}, {x + 1, top_y + height - 1}, faded(color::kText, 0.5));
    draw_dots(list, parts, curves_, frame);
    tooltip_at(context, frame);
  }
  list.PopClipRect();
  draw_row_line(list, strip, top_y + height - 1);
  ImGui::PopID();
}

}  // namespace sigs::editor
