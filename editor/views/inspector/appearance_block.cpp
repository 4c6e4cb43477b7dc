// SPDX-License-Identifier: MIT
#include "editor/views/inspector/inspector_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "editor/preview/jobs.h"

namespace sigs::editor {

namespace {

constexpr std::string_view kFirstOfColor = ", red";
constexpr std::size_t kParts = 3;  // red, green, blue, which follow each other

// Three digits, without an exponent.
std::string three_digits(double value) {
  return std::abs(value) < 1000 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

std::string deviation_text(double sd) {
  return sd < 100 ? fmt::format("{:.2g}", sd) : fmt::format("{:.0f}", sd);
}

std::string with_unit(const std::string& number, const std::string& unit) {
  if (unit == "deg") return number + "\u00b0";
  return unit.empty() ? number : number + " " + unit;
}

FoundLine line_of(const AppearanceQuantity& quantity) {
  const Estimate& estimate = quantity.estimate;
  const std::string name = capitalised(quantity.name);
  if (estimate.is_known)
    return {name, with_unit(three_digits(estimate.value) + " \u00b1 " + deviation_text(estimate.sd), quantity.unit), "",
            quantity.how};
  const bool is_clear = quantity.setting == "appearance.haze.visibility_m";  // of which there is no number
  const std::string taken = is_clear ? "clear air" : with_unit(three_digits(estimate.value), quantity.unit);
  return {name, "not known; " + taken, estimate.why};
}

FoundLine line_of_color(const AppearanceQuantity* parts) {
  const Estimate &red = parts[0].estimate, &green = parts[1].estimate, &blue = parts[2].estimate;
  const std::string name = capitalised(parts[0].name.substr(0, parts[0].name.size() - kFirstOfColor.size()));
  const std::string color = fmt::format("{:.2f} {:.2f} {:.2f}", red.value, green.value, blue.value);
  if (!red.is_known) return {name, "not known; " + color, red.why};
  return {name, fmt::format("{} \u00b1 {:.1g}", color, std::max({red.sd, green.sd, blue.sd})), ""};
}

void draw_cell(const std::string& text, bool is_quiet) {
  ImGui::TableNextColumn();
  draw_text(text, is_quiet ? color::kQuiet : ImGui::GetColorU32(ImGuiCol_Text));
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

RowOptions look_of(const Field& field, const Project& project) {
  const CompositingSettings& compositing = project.compositing;
  const HazeSettings& haze = project.appearance.haze;
  RowOptions look;
  look.is_hidden = field.key.starts_with("appearance.thermal.") && project.footage.spectrum != Spectrum::thermal;
  if (compositing.method != MethodChoice::direct) look.off_because = "Counts for the direct method alone.";
  if (field.key != "appearance.haze.airlight_color") return look;
  look.is_color = true;
  if (haze.airlight != AirlightChoice::color) look.off_because = "Counts where the airlight is a colour.";
  return look;
}

}  // namespace

std::vector<FoundLine> found_lines(const Appearance& appearance) {
  const std::vector<AppearanceQuantity> quantities = quantities_of(appearance);
  std::vector<FoundLine> lines;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const bool is_color = quantities[i].name.ends_with(kFirstOfColor) && i + kParts <= quantities.size();
    lines.push_back(is_color ? line_of_color(&quantities[i]) : line_of(quantities[i]));
    if (is_color) i += kParts - 1;
  }
  return lines;
}

void AppearanceBlock::draw_match(const ViewContext& context, const AppearanceState& state) {
  if (state.is_running()) {
    if (draw_job_progress(state)) context.edits.ask(StopMatchingFootage{});
    context.ui_probe.note_item("inspector/stop matching footage");
    return;
  }
  if (context.ui_probe.noted(
          ImGui::Button("Match the footage"), "inspector/match the footage",
          "Finds blur, noise, compression, haze and light in the footage, in the background, and sets them."))
    context.edits.ask(MatchFootage{});
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
  rows.rows("appearance.", [&](const Field& field) { return look_of(field, project); });
}

}  // namespace sigs::editor
