// SPDX-License-Identifier: MIT
#include "editor/views/results/results_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.h"

namespace sigs::editor {

const FrameScore* score_at(const ScoredTracker& tracker, int first_frame, int frame) {
  if (!tracker.score || frame < first_frame) return nullptr;
  const auto index = static_cast<std::size_t>(frame - first_frame);
  return index < tracker.score->frames.size() ? &tracker.score->frames[index] : nullptr;
}

TrackerMoment moment_of(const ScoredTracker& tracker, int first_frame, int frame) {
  const FrameScore* const score = score_at(tracker, first_frame, frame);
  if (score == nullptr) return TrackerMoment::unknown;
  if (!score->is_scored) return TrackerMoment::unscored;
  if (!score->is_reported) return TrackerMoment::silent;
  return score->is_lost ? TrackerMoment::lost : TrackerMoment::reported;
}

std::string signed_text(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  return fmt::format("{:+.{}f}", size < 0.005 ? 0.0 : value, size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.0f} %", 100 * share) : "-";
}

std::string moment_text(const ScoredTracker& tracker, int first_frame, int frame) {
  const FrameScore* const score = score_at(tracker, first_frame, frame);
  switch (moment_of(tracker, first_frame, frame)) {
    case TrackerMoment::unknown:
      return "-";
    case TrackerMoment::unscored:
      return "not scored";
    case TrackerMoment::silent:
      return "no report";
    case TrackerMoment::lost:
      return "lost, " + pixels_text(score->center_error_px.value_or(NAN));
    case TrackerMoment::reported:
      return pixels_text(score->center_error_px.value_or(NAN));
  }
  return "-";
}

std::string truth_text(const Scored& scored) {
  if (scored.target.empty()) return "There is no intruder to measure by.";
  if (scored.truth == TruthKind::measured)
    return fmt::format("By the visible pixels of {} in every frame; as sigs evaluate track has it.", scored.target);
  if (!scored.truth_problem.empty())
    return fmt::format("About, by the outline of {}: it cannot be measured. {}", scored.target, scored.truth_problem);
  std::string text = scored.truth == TruthKind::outlines
                         ? fmt::format("About, by the outline of {}; being measured", scored.target)
                         : "Measuring " + scored.target;
  if (scored.truth_total > 0)
    text += fmt::format(": {} of {}", scored.truth_done, count_text(scored.truth_total, "frame"));
  return text;
}

std::string shown_name(const Scored& scored, const ScoredTracker& tracker) {
  const auto same =
      std::ranges::count_if(scored.trackers, [&](const ScoredTracker& other) { return other.name == tracker.name; });
  return same > 1 ? tracker.file.path.parent_path().filename().string() + "/" + tracker.name : tracker.name;
}

namespace {

constexpr ImU32 kGround = IM_COL32(8, 9, 11, 255);
constexpr double kMaxName_px = 150;
constexpr double kFarApart_px = 12;  // of the screen: nearer middles need no line
constexpr double kFree_px = 24;

// From where the truth's middle must be, by the errors, to the reported one.
void draw_path_line(const ImageCanvas& canvas, const ScreenRect& box, const FrameScore* score, ImU32 shade) {
  if (score == nullptr || !score->dx_px || !score->dy_px) return;
  const glm::dvec2 to = (box.low + box.high) / 2.0;
  const glm::dvec2 direction = glm::dvec2(*score->dx_px, *score->dy_px) * canvas.view.zoom;
  const double length = glm::length(direction);
  if (length < scaled(kFarApart_px)) return;
  // What is followed stays free.
  const glm::dvec2 from = to - direction * std::max(0.5, 1 - scaled(kFree_px) / length);
  canvas.draw.AddLine(im(from), im(to), faded(kGround, 0.5), scaled(2.5));
  canvas.draw.AddLine(im(from), im(to), faded(shade, 0.75), scaled(1));
}

void draw_reported(const ImageCanvas& canvas, const Scored& scored, const ScoredTracker& tracker, int frame) {
  const ReportedBox* const reported = tracker.results ? tracker.results->best_at(frame) : nullptr;
  if (reported == nullptr) return;
  const ImU32 shade = result_color(tracker.file.color);
  const ScreenRect box = canvas.on_screen(reported->box);
  draw_path_line(canvas, box, score_at(tracker, scored.first_frame, frame), shade);
  // A dark line outside, none between the dashes: where it agrees with the truth, that shows through.
  const double line = std::max(1.0F, std::round(scaled(1)));
  draw_outline(canvas, {box.low - 2 * line, box.high + 2 * line}, faded(kGround, 0.55), false);
  draw_outline(canvas, {box.low - line, box.high + line}, shade, true);
  draw_outline(canvas, box, shade, true);
}

struct LegendLine {
  std::string name;
  std::string value;
  ImU32 color = 0;
  bool is_dashed = true;
};

std::vector<LegendLine> legend_of(const Scored& scored, int frame) {
  std::vector<LegendLine> lines{{.name = "truth", .color = color::kBox, .is_dashed = false}};
  for (const ScoredTracker& tracker : scored.trackers) {
    if (!tracker.file.is_shown || !tracker.results) continue;
    lines.push_back({.name = elided(shown_name(scored, tracker), scaled(kMaxName_px)),
                     .value = moment_text(tracker, scored.first_frame, frame),
                     .color = result_color(tracker.file.color)});
  }
  return lines;
}

void draw_sample(ImDrawList& list, ImVec2 at, float width, const LegendLine& line) {
  const float thick = std::max(2.0F, scaled(2));
  const float dash = line.is_dashed ? scaled(5) : width;
  for (float x = 0; x < width; x += 2 * dash)
    list.AddRectFilled({at.x + x, at.y - thick / 2}, {at.x + std::min(x + dash, width), at.y + thick / 2}, line.color);
}

constexpr int kColumns = 7;  // eye, name, four figures, remove

struct Column {
  const char* title;
  const char* help;
};
constexpr Column kFigures[] = {
    {"CLE", "mean distance of the middles in pixels, over the frames with a report"},
    {"P20", "precision: in how many of the scored frames the middles are at most 20 px apart"},
    {"AUC", "success: area under the curve of overlaps, in percent"},
    {"lost", "scored frames without a report, or with one that does not touch the truth"},
};

void right_aligned(const std::string& text, ImU32 shade) {
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(shade), "%s", text.c_str());
}

void draw_head(const Scored& scored) {
  const bool is_about = scored.truth == TruthKind::outlines;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  for (const Column& column : kFigures) {
    ImGui::TableNextColumn();
    right_aligned(column.title, color::kQuiet);
    tooltip_for_item(is_about ? (std::string(column.help) + " (about)").c_str() : column.help);
  }
}

std::string without_unit(const std::string& text) {
  return text.substr(0, text.find(' '));
}

// A square in the tracker's colour, hollow while it is not shown; switches that.
void draw_switch(const ViewContext& context, const ScoredTracker& tracker, const std::string& place) {
  const float side = ImGui::GetFrameHeight();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  if (context.ui_probe.noted(ImGui::InvisibleButton("show", {side * 0.8F, side}), place + "/show",
                             tracker.file.is_shown ? "hide its boxes and its curve" : "show its boxes and its curve"))
    context.edits.ask(ShowResults{tracker.file.id, !tracker.file.is_shown});
  const float half = side * 0.26F;
  const ImVec2 middle{low.x + side * 0.4F, low.y + side / 2};
  const ImU32 shade = result_color(tracker.file.color);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (tracker.file.is_shown)
    list.AddRectFilled({middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}, shade, scaled(2));
  else
    list.AddRect({middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}, shade, scaled(2));
}

void draw_figures(const Scored& scored, const ScoredTracker& tracker) {
  const TrackScore* const score = tracker.score.get();
  const ImU32 shade = scored.truth == TruthKind::measured ? color::kText : color::kQuiet;
  const bool is_scored = score != nullptr && score->scored > 0;
  const std::string figures[] = {is_scored ? without_unit(pixels_text(score->mean_center_error_px)) : "-",
                                 is_scored ? without_unit(percent_text(score->precision_at_20)) : "-",
                                 is_scored ? without_unit(percent_text(score->success_auc)) : "-",
                                 is_scored ? std::to_string(score->lost) : "-"};
  for (const std::string& figure : figures) {
    ImGui::TableNextColumn();
    right_aligned(figure, shade);
  }
}

std::string counts_text(const ScoredTracker& tracker) {
  std::string text = tracker.file.path.string();
  if (!tracker.score) return text;
  const TrackScore& score = *tracker.score;
  text += fmt::format("\n{} of {} scored frames reported, {} lost", score.reported, score.scored, score.lost);
  if (score.reported_absent > 0)
    text += fmt::format("; reported in {} in which there is nothing", count_text(score.reported_absent, "frame"));
  text += fmt::format("\nmean dx {} px, dy {} px; median {}, 95 % below {}", signed_text(score.mean_dx_px),
                      signed_text(score.mean_dy_px), pixels_text(score.median_center_error_px),
                      pixels_text(score.p95_center_error_px));
  return text;
}

void draw_tracker(const ViewContext& context, const ScoredTracker& tracker) {
  const Scored& scored = *context.scored;
  const std::string place = "results/" + tracker.name;
  ImGui::PushID(tracker.file.id);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  draw_switch(context, tracker, place);
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  const bool is_bad = !tracker.problem.empty();
  const std::string name = elided(shown_name(scored, tracker), ImGui::GetContentRegionAvail().x);
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(is_bad ? color::kBad : color::kText), "%s", name.c_str());
  context.ui_probe.note_item(is_bad ? place + "/problem" : place,
                             (is_bad ? tracker.problem : counts_text(tracker)).c_str());
  draw_figures(scored, tracker);
  ImGui::TableNextColumn();
  if (context.ui_probe.noted(icon_button("remove", Icon::cross, "remove it from here; the file stays"),
                             place + "/remove"))
    context.edits.ask(RemoveResults{tracker.file.id});
  ImGui::PopID();
}

void draw_table(const ViewContext& context) {
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {scaled(3), 0});
  if (ImGui::BeginTable("trackers", kColumns, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("shown");
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    for (const Column& column : kFigures)
      ImGui::TableSetupColumn(column.title, ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("0.000").x);
    ImGui::TableSetupColumn("remove");
    draw_head(*context.scored);
    for (const ScoredTracker& tracker : context.scored->trackers) draw_tracker(context, tracker);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
}

// Why a file cannot be used, in full below the table.
void draw_problems(const Scored& scored) {
  for (const ScoredTracker& tracker : scored.trackers) {
    if (tracker.problem.empty()) continue;
    draw_wrapped(shortened(tracker.problem), color::kBad);
  }
}

void draw_truth(const ViewContext& context) {
  const Scored& scored = *context.scored;
  ImGui::PushFont(font(Font::small));
  ImGui::PushStyleColor(ImGuiCol_Text, scored.truth == TruthKind::measured ? color::kQuiet : color::kPartly);
  ImGui::TextWrapped("%s", truth_text(scored).c_str());
  context.ui_probe.note_item(scored.truth == TruthKind::measured ? "results/measured" : "results/about");
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

}  // namespace

void draw_result_boxes(const ImageCanvas& canvas, const ViewContext& context, int frame) {
  if (context.scored == nullptr) return;
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (const ScoredTracker& tracker : context.scored->trackers)
    if (tracker.file.is_shown) draw_reported(canvas, *context.scored, tracker, frame);
  canvas.draw.PopClipRect();
}

void draw_result_legend(const ImageCanvas& canvas, const ViewContext& context, int frame) {
  if (context.scored == nullptr) return;
  ImGui::PushFont(font(Font::small));
  const std::vector<LegendLine> lines = legend_of(*context.scored, frame);
  const float sample = scaled(25);
  const float gap = scaled(7);
  const float row = std::ceil(ImGui::GetFontSize() + scaled(3));
  float names = 0;
  float values = 0;
  for (const LegendLine& line : lines) {
    names = std::max(names, ImGui::CalcTextSize(line.name.c_str()).x);
    values = std::max(values, ImGui::CalcTextSize(line.value.c_str()).x);
  }
  const ImVec2 size{2 * gap + sample + gap + names + 2 * gap + values, static_cast<float>(lines.size()) * row + gap};
  const glm::dvec2 low = glm::floor(glm::dvec2(canvas.rect.low.x + scaled(8), canvas.rect.high.y - scaled(8) - size.y));
  const ImVec2 at = im(low);
  context.ui_probe.note("viewport/legend", {low, low + glm::dvec2(size.x, size.y)});
  canvas.draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(12, 13, 16, 205), scaled(3));
  float y = at.y + gap / 2;
  for (const LegendLine& line : lines) {
    draw_sample(canvas.draw, {at.x + gap, std::floor(y + row / 2)}, sample, line);
    const float x = at.x + gap + sample + gap;
    canvas.draw.AddText({x, y}, color::kText, line.name.c_str());
    canvas.draw.AddText({x + names + 2 * gap, y}, line.color, line.value.c_str());
    y += row;
  }
  ImGui::PopFont();
}

void draw_results_panel(const ViewContext& context) {
  if (context.scored == nullptr) return;
  draw_table(context);
  draw_problems(*context.scored);
  if (context.ui_probe.noted(ImGui::Button("Load more..."), "results/load",
                             "Another tracker's result file; files can be dropped onto the window as well"))
    context.edits.ask(LoadResults{});
  // Below the button, or that would move as the text grows and shrinks.
  draw_truth(context);
}

}  // namespace sigs::editor
