// SPDX-License-Identifier: MIT
#include "editor/views/dialogs.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

#include "editor/widgets/dialog.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

void close_row(UiProbe& ui_probe, bool& closed) {
  ImGui::Dummy({0, scaled(6)});
  const char* const labels[] = {"Close"};
  align_buttons_right(labels, 1);
  if (dialog_button("Close", true)) closed = true;
  ui_probe.note_item("dialog/Close");
}

void draw_help_group(std::span<const HelpLine> lines, std::size_t& i) {
  const std::string& group = lines[i].group;
  ImGui::PushFont(font(Font::bold));
  ImGui::TextUnformatted(group.c_str());
  ImGui::PopFont();
  if (ImGui::BeginTable(group.c_str(), 2)) {
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 1.1F);
    for (; i < lines.size() && lines[i].group == group; ++i) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::PushStyleColor(ImGuiCol_Text, color::kAccent);
      ImGui::TextWrapped("%s", lines[i].keys.c_str());
      ImGui::PopStyleColor();
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", lines[i].what.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::Dummy({0, scaled(6)});
}

}  // namespace

std::optional<int> draw_question(const Question& question, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog((question.title + "###question").c_str(), 460, 0, closed)) return std::nullopt;
  std::optional<int> answer;
  ImGui::Dummy({0, scaled(4)});
  ImGui::TextWrapped("%s", shortened(question.text).c_str());
  ImGui::Dummy({0, scaled(10)});
  // As on other desktops: what changes nothing comes first, the usual answer last.
  std::vector<const char*> labels;
  for (std::size_t i = question.answers.size(); i-- > 0;) labels.push_back(question.answers[i].c_str());
  align_buttons_right(labels.data(), static_cast<int>(labels.size()));
  for (std::size_t i = question.answers.size(); i-- > 0;) {
    if (dialog_button(question.answers[i].c_str(), i == 0)) answer = static_cast<int>(i);
    ui_probe.note_item("question/" + question.answers[i]);
    if (i > 0) ImGui::SameLine();
  }
  if (pressed(Key::enter) || pressed(Key::keypad_enter)) answer = 0;
  if (closed) answer = static_cast<int>(question.answers.size()) - 1;
  end_dialog(!answer);
  return answer;
}

bool draw_help(std::span<const HelpLine> lines, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog("Keys###help", 860, 560, closed)) return !closed;
  const float bottom = scaled(28) + scaled(6) + 2 * ImGui::GetStyle().ItemSpacing.y;
  const bool wide = ImGui::GetContentRegionAvail().x > scaled(560);
  ImGui::BeginChild("lines", {0, ImGui::GetContentRegionAvail().y - bottom});
  if (ImGui::BeginTable("halves", wide ? 2 : 1)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool second = !wide;
    for (std::size_t i = 0; i < lines.size();) {
      if (!second && i >= (lines.size() + 1) / 2) {
        ImGui::TableNextColumn();
        second = true;
      }
      draw_help_group(lines, i);
    }
    ImGui::EndTable();
  }
  ImGui::EndChild();
  close_row(ui_probe, closed);
  end_dialog(!closed);
  return !closed;
}

bool draw_about(const std::string& version, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog("About###about", 420, 0, closed)) return !closed;
  ImGui::PushFont(font(Font::title));
  ImGui::TextUnformatted("SIGS");
  ImGui::PopFont();
  ImGui::TextDisabled("Version %s", version.c_str());
  ImGui::Dummy({0, scaled(4)});
  ImGui::TextWrapped(
      "Puts simulated intruder aircraft into real footage from unmanned aircraft, through the camera's own lens, and "
      "writes the exact ground truth next to it.");
  ImGui::Dummy({0, scaled(4)});
  ImGui::TextDisabled("MIT licence");
  close_row(ui_probe, closed);
  end_dialog(!closed);
  return !closed;
}

bool SettingsDialog::draw(Settings& settings, UiProbe& ui_probe) {
  bool closed = false;
  if (!begin_dialog("Settings###settings", 480, 0, closed)) return !closed;
  if (ImGui::BeginTable("settings", 2)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1.2F);
    begin_setting("Size of the text", "Everything else follows it");
    ImGui::SetNextItemWidth(-1);
    auto font_px = static_cast<int>(font_px_ > 0 ? font_px_ : settings.font_px);
    if (ImGui::SliderInt("##font", &font_px, static_cast<int>(kMinFont_px), static_cast<int>(kMaxFont_px), "%d px",
                         ImGuiSliderFlags_AlwaysClamp))
      font_px_ = font_px;
    ui_probe.note_item("settings/font");
    if (ImGui::IsItemDeactivatedAfterEdit() && font_px_ > 0) settings.font_px = font_px_;
    if (!ImGui::IsItemActive()) font_px_ = 0;
    begin_setting("Keep unsaved changes after",
                  "Seconds after a change until it is kept on disk for the case of a crash");
    ImGui::SetNextItemWidth(-1);
    auto autosave_s = static_cast<float>(settings.autosave_s);
    if (ImGui::SliderFloat("##autosave", &autosave_s, 1, 300, "%.0f s",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
      settings.autosave_s = autosave_s;
    ui_probe.note_item("settings/autosave");
    begin_setting("Playing starts again at the end", "Loop over the range between in and out");
    ImGui::Checkbox("##loop", &settings.loop);
    ui_probe.note_item("settings/loop");
    ImGui::EndTable();
  }
  close_row(ui_probe, closed);
  end_dialog(!closed);
  return !closed;
}

namespace {

namespace fs = std::filesystem;

void colored_text(ImU32 color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(elided(text, ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopStyleColor();
  tooltip_for_item(text.c_str());
}

}  // namespace

void RelinkDialog::open(const Project& project) {
  missing_ = missing_files(project);
  places_.clear();
  suggested_.clear();
  open_ = true;
}

void RelinkDialog::found(const MissingFile& missing, const fs::path& place) {
  places_[missing.field] = place;
  for (const Relinked& other : suggested_places(missing_, missing, place)) suggested_[other.field] = other.place;
}

void RelinkDialog::browse(const ViewContext& context, const MissingFile& missing) {
  const std::string extension = missing.place.extension().string();
  context.edits.ask(AskForFile{.title = fmt::format("Where is {}?", missing.place.filename().string()),
                               .extensions = extension.empty() ? std::vector<std::string>() : std::vector{extension},
                               .start = missing.place.parent_path(),
                               .chosen = [this, missing](const fs::path& place) { found(missing, place); }});
}

void RelinkDialog::apply(const ViewContext& context) const {
  std::vector<Relinked> places;
  for (const auto& [field, place] : places_) places.push_back({field, place});
  context.edits.change("find missing files", [places](Project& project) { relink(project, places); });
}

void RelinkDialog::draw_rows(const ViewContext& context) {
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    const MissingFile& missing = missing_[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    colored_text(color::kText, missing.path);
    colored_text(color::kQuiet, missing.field);
    ImGui::TableNextColumn();
    const auto place = places_.find(missing.field);
    const auto suggested = suggested_.find(missing.field);
    if (place != places_.end())
      colored_text(color::kGood, place->second.string());
    else if (suggested != suggested_.end())
      colored_text(color::kPartly, "perhaps " + suggested->second.string());
    else
      colored_text(color::kBad, "missing");
    ImGui::TableNextColumn();
    if (dialog_button("Browse...")) browse(context, missing);
    context.ui_probe.note_item("relink/browse." + missing.field);
    ImGui::PopID();
  }
}

void RelinkDialog::draw(const ViewContext& context) {
  bool closed = false;
  if (!begin_dialog("Missing files###relink", 760, 420, closed)) {
    open_ = open_ && !closed;
    return;
  }
  ImGui::TextWrapped("%s", missing_.empty() ? "All files that the project names are there."
                                            : "These files are not where the project says. Show where one of them is; "
                                              "the others are looked for near it.");
  const float bottom = scaled(28) + scaled(6) + 2 * ImGui::GetStyle().ItemSpacing.y;
  const float height = std::max(scaled(60), ImGui::GetContentRegionAvail().y - bottom);
  if (ImGui::BeginTable("missing", 3, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height})) {
    ImGui::TableSetupColumn("file", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("place", ImGuiTableColumnFlags_WidthStretch, 1.2F);
    ImGui::TableSetupColumn("browse", ImGuiTableColumnFlags_WidthFixed, dialog_button_width("Browse..."));
    draw_rows(context);
    ImGui::EndTable();
  }
  const bool has_suggestions = std::any_of(suggested_.begin(), suggested_.end(),
                                           [this](const auto& item) { return !places_.contains(item.first); });
  const char* const labels[] = {"Use suggestions", "Cancel", "Use these"};
  align_buttons_right(labels, 3);
  if (dialog_button("Use suggestions", false, has_suggestions)) places_.insert(suggested_.begin(), suggested_.end());
  context.ui_probe.note_item("relink/suggestions");
  ImGui::SameLine();
  if (dialog_button("Cancel")) closed = true;
  ImGui::SameLine();
  if (dialog_button("Use these", true, !places_.empty())) {
    apply(context);
    closed = true;
  }
  context.ui_probe.note_item("relink/apply");
  open_ = !closed;
  end_dialog(open_);
}

}  // namespace sigs::editor
