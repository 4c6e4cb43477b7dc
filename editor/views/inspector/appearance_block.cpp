// SPDX-License-Identifier: MIT
#include "editor/views/inspector/appearance_block.h"

#include <fmt/format.h>
#include <imgui.h>

#include "editor/preview/appearance_job.h"
#include "editor/views/inspector/appearance_found.h"
#include "editor/views/inspector/job_progress.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

void draw_cell(const std::string& text, bool is_quiet) {
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, is_quiet ? color::kQuiet : ImGui::GetColorU32(ImGuiCol_Text));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void draw_line(const FoundLine& line) {
  ImGui::TableNextRow();
  draw_cell(line.name, true);
  draw_cell(line.value, !line.why.empty());
  tooltip_for_item(line.why.empty() ? line.how.c_str() : line.why.c_str());
}

void draw_found(const ViewContext& context, const Appearance& appearance) {
  ImGui::BeginGroup();
  ImGui::PushFont(font(Font::small));
  if (ImGui::BeginTable("found", 2)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    for (const FoundLine& line : found_lines(appearance)) draw_line(line);
    ImGui::EndTable();
  }
  ImGui::PopFont();
  ImGui::EndGroup();
  context.ui_probe.note_item("inspector/found in the footage");
}

RowOptions look_of(const Field& field, const CompositingSettings& compositing, const HazeSettings& haze) {
  RowOptions look;
  if (compositing.method != MethodChoice::direct) look.off_because = "Counts for the direct method alone.";
  if (field.key != "appearance.haze.airlight_color") return look;
  look.is_color = true;
  if (haze.airlight != AirlightChoice::color) look.off_because = "Counts where the airlight is a colour.";
  return look;
}

}  // namespace

void AppearanceBlock::draw_match(const ViewContext& context, const AppearanceState& state) {
  if (state.is_running()) {
    if (draw_job_progress(state)) context.edits.ask(StopMatchingFootage{});
    context.ui_probe.note_item("inspector/stop matching footage");
    return;
  }
  if (ImGui::Button("Match the footage")) context.edits.ask(MatchFootage{});
  context.ui_probe.note_item("inspector/match the footage");
  tooltip_for_item("Finds blur, noise, compression, haze and light in the footage, in the background, and sets them.");
  if (state.value && state.value != shown_) ImGui::SetScrollHereY(0);
  shown_ = state.value;
  if (!state.value) return;
  draw_found(context, *state.value);
  ImGui::Separator();
}

void AppearanceBlock::draw(const ViewContext& context, FieldRows& rows) {
  if (context.appearance != nullptr) draw_match(context, *context.appearance);
  ImGui::Spacing();
  const Project& project = context.project();
  rows.rows("appearance.",
            [&](const Field& field) { return look_of(field, project.compositing, project.appearance.haze); });
}

}  // namespace sigs::editor
