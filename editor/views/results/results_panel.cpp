// SPDX-License-Identifier: MIT
#include "editor/views/results/results_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "editor/views/results/result_texts.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

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

std::string number_text(double value) {
  std::string text = pixels_text(value);
  return text.substr(0, text.find(' '));
}

std::string share_text(double share) {
  const std::string text = percent_text(share);
  return text.substr(0, text.find(' '));
}

// A square in the tracker's colour, hollow while it is not shown; switches that.
void draw_switch(const ViewContext& context, const ScoredTracker& tracker, const std::string& place) {
  const float side = ImGui::GetFrameHeight();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton("show", {side * 0.8F, side}))
    context.edits.ask(ShowResults{tracker.file.id, !tracker.file.is_shown});
  context.ui_probe.note_item(place + "/show");
  tooltip_for_item(tracker.file.is_shown ? "hide its boxes and its curve" : "show its boxes and its curve");
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
  const std::string figures[] = {
      is_scored ? number_text(score->mean_center_error_px) : "-", is_scored ? share_text(score->precision_at_20) : "-",
      is_scored ? share_text(score->success_auc) : "-", is_scored ? std::to_string(score->lost) : "-"};
  for (const std::string& figure : figures) {
    ImGui::TableNextColumn();
    right_aligned(figure, shade);
  }
}

std::string counts_text(const ScoredTracker& tracker) {
  std::string text = tracker.file.path.string();
  if (!tracker.score) return text;
  const TrackScore& score = *tracker.score;
  text += "\n" + std::to_string(score.reported) + " of " + std::to_string(score.scored) + " scored frames reported, " +
          std::to_string(score.lost) + " lost";
  if (score.reported_absent > 0)
    text += "; reported in " + std::to_string(score.reported_absent) + " frames in which there is nothing";
  text += "\nmean dx " + signed_text(score.mean_dx_px) + " px, dy " + signed_text(score.mean_dy_px) + " px; median " +
          pixels_text(score.median_center_error_px) + ", 95 % below " + pixels_text(score.p95_center_error_px);
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
  context.ui_probe.note_item(is_bad ? place + "/problem" : place);
  tooltip_for_item((is_bad ? tracker.problem : counts_text(tracker)).c_str());
  draw_figures(scored, tracker);
  ImGui::TableNextColumn();
  if (icon_button("remove", Icon::cross, "remove it from here; the file stays"))
    context.edits.ask(RemoveResults{tracker.file.id});
  context.ui_probe.note_item(place + "/remove");
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
    ImGui::PushStyleColor(ImGuiCol_Text, color::kBad);
    ImGui::TextWrapped("%s", shortened(tracker.problem).c_str());
    ImGui::PopStyleColor();
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

void draw_results_panel(const ViewContext& context) {
  if (context.scored == nullptr) return;
  draw_table(context);
  draw_problems(*context.scored);
  if (ImGui::Button("Load more...")) context.edits.ask(LoadResults{});
  context.ui_probe.note_item("results/load");
  tooltip_for_item("Another tracker's result file; files can be dropped onto the window as well");
  // Below the button, or that would move as the text grows and shrinks.
  draw_truth(context);
}

}  // namespace sigs::editor
