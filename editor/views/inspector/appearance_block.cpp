// SPDX-License-Identifier: MIT
#include "editor/views/inspector/appearance_block.h"

#include <fmt/format.h>
#include <imgui.h>

#include "editor/preview/appearance_job.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

void draw_running(const ViewContext& context, const AppearanceState& state) {
  const float share = state.total > 0 ? static_cast<float>(state.done) / static_cast<float>(state.total) : 0;
  const std::string text = state.total > 0 ? fmt::format("{} of {} frames", state.done, state.total) : "reading";
  ImGui::ProgressBar(share, {-1, 0}, text.c_str());
  ImGui::BeginDisabled(state.is_stopping);
  if (ImGui::Button("Stop")) context.edits.ask(StopMatchingFootage{});
  ImGui::EndDisabled();
  context.ui_probe.note_item("inspector/stop matching footage");
}

void draw_found(const Appearance& appearance) {
  for (const AppearanceQuantity& quantity : quantities_of(appearance))
    note(quantity.name + ": " + text_of(quantity));
}

}  // namespace

void draw_appearance(const ViewContext& context, FieldRows& rows) {
  const bool is_direct = context.project().compositing.method == MethodChoice::direct;
  rows.rows("appearance.", [&](const Field& field) {
    RowOptions look;
    if (!is_direct) look.off_because = "Counts for the direct method alone.";
    if (field.key == "appearance.haze.airlight_color") {
      look.is_color = true;
      if (context.project().appearance.haze.airlight != AirlightChoice::color)
        look.off_because = "Counts where the airlight is a colour.";
    }
    return look;
  });
  if (context.appearance == nullptr) return;
  ImGui::Spacing();
  if (context.appearance->is_running()) return draw_running(context, *context.appearance);
  if (ImGui::Button("Match the footage")) context.edits.ask(MatchFootage{});
  context.ui_probe.note_item("inspector/match the footage");
  tooltip_for_item("Finds blur, noise, compression, haze and light in the footage, in the background, and sets them.");
  if (context.appearance->value) draw_found(*context.appearance->value);
}

}  // namespace sigs::editor
