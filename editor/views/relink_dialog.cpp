// SPDX-License-Identifier: MIT
#include "editor/views/relink_dialog.h"

#include <imgui.h>

#include <algorithm>

#include "editor/widgets/dialog.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

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
  context.edits.ask(AskForFile{.title = "Where is " + missing.place.filename().string() + "?",
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
