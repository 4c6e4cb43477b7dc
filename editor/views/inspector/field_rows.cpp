// SPDX-License-Identifier: MIT
#include "editor/views/inspector/field_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>

#include "editor/document/project_paths.h"

namespace sigs::editor {

namespace {

constexpr double kNarrow = 250;
constexpr float kLabelShare = 0.4F;

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

bool has_problem(const ProblemsByField& problems, std::string_view key) {
  const auto found = problems.lower_bound(key);
  return found != problems.end() && found->first.starts_with(key);
}

void note(const std::string& text, bool is_warning) {
  draw_wrapped(shortened(text), is_warning ? color::kPartly : color::kQuiet, Font::small);
}

void frame_link(const ViewContext& context, const std::string& text, double frame, ImU32 shade) {
  draw_wrapped(text, shade);
  if (!ImGui::IsItemHovered()) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  ImGui::GetWindowDrawList()->AddLine({low.x, high.y}, {high.x, high.y}, faded(shade, 0.5));
  tooltip_for_item("Go to this frame");
  if (ImGui::IsItemClicked()) context.edits.go_to_frame(static_cast<int>(std::lround(frame)));
}

bool ButtonFlow::button(const char* label, const char* tooltip, bool enabled) {
  const float gap = scaled(6);
  const float width = ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  if (right_x_ >= 0 && right_x_ + gap + width <= right) ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(!enabled);
  const bool clicked = ImGui::Button(label);
  ImGui::EndDisabled();
  right_x_ = ImGui::GetItemRectMax().x;
  tooltip_for_item(tooltip);
  return clicked;
}

void RowMemory::refresh(const ViewContext& context) {
  if (std::exchange(document, context.document.first_number()) != document) typing = {};
  if (sheet && sheet_revision == context.document.revision().number) return;
  sheet.emplace(context.project());
  sheet_revision = context.document.revision().number;
}

float FieldRows::begin_row(const std::string& label, bool below) {
  const float room = ImGui::GetContentRegionAvail().x;
  const bool above = below || ImGui::GetContentRegionAvail().x < scaled(kNarrow);
  const float width = above ? room - icon_button_width() : room * kLabelShare - scaled(6);
  const float start = ImGui::GetCursorPosX();
  if (!above) ImGui::AlignTextToFramePadding();
  const std::string shown = elided(label, width);
  ImGui::TextUnformatted(shown.c_str());
  if (shown != label) tooltip_for_item(label.c_str());
  if (!above) ImGui::SameLine(start + room * kLabelShare, 0);
  const float side = below ? 0 : icon_button_width() + scaled(2);
  return std::max(scaled(30), (above ? room : room * (1 - kLabelShare)) - side);
}

void FieldRows::draw_hint(const Field& field, const RowOptions& look) const {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  std::string text = capitalised(std::string(field.help));
  if (const std::string range = range_text(field); !range.empty()) text += "\nRange: " + range;
  text += "\nDefault: " + value_text(field, sheet_.default_of(field));
  if (field.is_path && !value_text(field, value_of(field)).empty())
    text += "\nNow: " + value_text(field, value_of(field));
  if (!look.off_because.empty()) text += "\n" + look.off_because;
  text += "\n" + field.key;
  tooltip_for_item(text.c_str());
}

void FieldRows::browse(const Field& field) {
  std::error_code code;
  const Project& project = context_.project();
  std::filesystem::path start = resolved(project, *std::get<std::string*>(field.value)).parent_path();
  if (start.empty() || !std::filesystem::is_directory(start, code)) start = project.file.parent_path();
  Edits& edits = context_.edits;
  context_.edits.ask(AskForFile{.title = "Choose: " + lower_first(label_of(field.key)),
                                .extensions = extensions_for(field.key),
                                .start = start,
                                .chosen = [&edits, key = field.key](const std::filesystem::path& path) {
                                  edits.change("choose " + lower_first(label_of(key)), [key, path](Project& changed) {
                                    put_value(changed, key, path_in_project(changed, path));
                                  });
                                }});
}

// Beside the editor, so that all editors end in one line: choosing a file, and going back to the default.
void FieldRows::draw_side_buttons(const Field& field, float top_y) {
  const bool can_be_reset = sheet_.can_be_reset(field);
  if (!field.is_path && !can_be_reset) return;
  const ImVec2 after = ImGui::GetCursorScreenPos();
  const float right = after.x + ImGui::GetContentRegionAvail().x;
  ImGui::SetCursorScreenPos({right - icon_button_width(), top_y});
  if (field.is_path) {
    if (context_.ui_probe.noted(icon_button("browse", Icon::folder, "Choose a file"),
                                fmt::format("{}{}/browse", place_, field.key)))
      browse(field);
  } else {
    const std::string text = "Back to " + value_text(field, sheet_.default_of(field));
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(0, 0, 0, 0));
    if (icon_button("reset", Icon::reset, text.c_str())) change(field, {sheet_.default_of(field), true});
    ImGui::PopStyleColor();
    context_.ui_probe.note_item(place_ + field.key + "/reset");
  }
  ImGui::SetCursorScreenPos(after);
}

void FieldRows::change(const Field& field, const Edited& edited) {
  const std::string gesture = edited.is_finished ? "" : "inspector " + field.key;
  context_.edits.change(
      "change " + lower_first(label_of(field.key)),
      [key = field.key, value = edited.value](Project& project) { put_value(project, key, value); }, gesture);
  memory_.gesture_is_open = !edited.is_finished;
}

bool FieldRows::is_left_out(std::string_view key) const {
  if (!leaves_out_uncommon_ || is_common(key) || problems_.find(key) != problems_.end()) return false;
  if (memory_.wanted_key == key || memory_.typing.key == key) return false;
  return context_.guesses == nullptr || std::none_of(context_.guesses->begin(), context_.guesses->end(),
                                                     [&](const Problem& guess) { return guess.field == key; });
}

void FieldRows::row(std::string_view key, const RowOptions& look) {
  const Field* const field = sheet_.find(key);
  if (field == nullptr) return;
  if (is_left_out(key)) {
    ++left_out_;
    return;
  }
  const bool is_wrong = problems_.find(key) != problems_.end();
  const bool below = std::holds_alternative<glm::dvec3*>(field->value) && !look.is_color;
  ImGui::PushID(field->key.c_str());
  const float label_y = ImGui::GetCursorScreenPos().y;
  std::string label = look.label.empty() ? label_of(key) : look.label;
  if (below && !field->unit.empty()) label += " (" + std::string(field->unit) + ")";
  const float width = begin_row(label, below);
  const float top_y = below ? label_y - ImGui::GetStyle().FramePadding.y : ImGui::GetCursorScreenPos().y;
  if (memory_.wanted_updates > 0 && memory_.wanted_key == key) {
    ImGui::SetScrollHereY(0.3F);
    ImGui::SetKeyboardFocusHere();
    memory_.wanted_updates = 0;
  }
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, is_wrong ? scaled(1) : 0);
  if (is_wrong) ImGui::PushStyleColor(ImGuiCol_Border, color::kBad);
  ImGui::BeginDisabled(!look.off_because.empty());
  ImGui::BeginGroup();
  const std::optional<Edited> edited = field_input(*field, look, width, memory_.typing);
  ImGui::EndGroup();
  const bool is_left = ImGui::IsItemDeactivated() || (edited && !ImGui::IsItemActive());
  ImGui::EndDisabled();
  if (is_wrong) ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  context_.ui_probe.note_item(place_ + field->key);
  draw_hint(*field, look);
  if (edited) change(*field, *edited);
  if (is_left) context_.edits.end_gesture();
  draw_side_buttons(*field, top_y);
  problem_lines(key);
  guess_lines(key);
  ImGui::PopID();
}

void FieldRows::rows(std::string_view prefix, const std::function<RowOptions(const Field&)>& look_of) {
  for (const Field& field : sheet_.fields()) {
    if (!field.key.starts_with(prefix)) continue;
    const RowOptions look = look_of ? look_of(field) : RowOptions();
    if (!look.is_hidden) row(field.key, look);
  }
}

void FieldRows::problem_lines(std::string_view key) {
  const auto [first, last] = problems_.equal_range(key);
  for (auto found = first; found != last; ++found) {
    const Field* const field = sheet_.find(key);
    const std::string what_to_do = advice(found->second, field);
    // Nothing is wrong with what was not chosen yet: its empty frame is red enough.
    if (field != nullptr && field->is_path && std::get<std::string*>(field->value)->empty()) {
      note(what_to_do);
      continue;
    }
    draw_wrapped(shortened(capitalised(found->second.what) + (what_to_do.empty() ? "" : ". " + what_to_do), 400),
                 color::kBad);
  }
}

void FieldRows::guess_lines(std::string_view key) {
  if (context_.guesses == nullptr) return;
  for (const Problem& guess : *context_.guesses) {
    // A guess of a group of settings is told below the first of them.
    const bool is_of_group = key.starts_with(guess.field) && key.substr(guess.field.size()).starts_with('.');
    if (guess.field != key && (!is_of_group || !told_groups_.insert(guess.field).second)) continue;
    ImGui::PushStyleColor(ImGuiCol_Text, color::kAccent);
    ImGui::PushFont(font(Font::small));
    ImGui::PushTextWrapPos(0);
    const std::string what_to_do = advice_on_guess(guess.field);
    const std::string text = "Guessed: " + guess.what + (what_to_do.empty() ? "" : ". " + what_to_do);
    ImGui::TextUnformatted(shortened(text, 500).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    ImGui::PopStyleColor();
  }
}

void FieldRows::finish() {
  if (memory_.gesture_is_open && !ImGui::IsAnyItemActive()) {
    context_.edits.end_gesture();
    memory_.gesture_is_open = false;
  }
  if (memory_.wanted_updates > 0) --memory_.wanted_updates;
}

bool draw_job_progress(int done, int total, bool is_stopping) {
  const std::string text = total > 0 ? fmt::format("{} of {} frames", done, total) : "reading";
  ImGui::ProgressBar(share_done(done, total), {-1, 0}, text.c_str());
  ImGui::BeginDisabled(is_stopping);
  const bool is_clicked = ImGui::Button("Stop");
  ImGui::EndDisabled();
  return is_clicked;
}

}  // namespace sigs::editor
