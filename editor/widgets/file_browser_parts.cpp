// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "editor/widgets/dialog.h"
#include "editor/widgets/file_browser.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

std::string filter_text(const std::vector<std::string>& extensions) {
  std::string text;
  for (const std::string& extension : extensions) text += (text.empty() ? "*" : ", *") + extension;
  return text.empty() ? "All files" : text;
}

// A row that can be clicked, with an icon before its text; drawn so that text never runs out of it.
bool icon_row(const char* id, Icon icon, ImU32 color, const std::string& text, bool selected, float width) {
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight() + scaled(6);
  ImGui::PushID(id);
  const bool clicked = ImGui::Selectable("##row", selected, 0, {width, height});
  ImGui::PopID();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_icon(list, icon, {place.x + scaled(11), place.y + height / 2}, scaled(14), color);
  list.AddText({place.x + scaled(24), place.y + scaled(3)}, color::kText, elided(text, width - scaled(28)).c_str());
  return clicked;
}

}  // namespace

void FileBrowser::draw_path_bar() {
  ImGui::BeginDisabled(!folder_.has_relative_path());
  if (icon_button("up", Icon::chevron_left, "The folder above (Backspace)")) go_up();
  ImGui::EndDisabled();
  ImGui::SameLine();
  const float buttons = 2 * (icon_button_width() + ImGui::GetStyle().ItemSpacing.x);
  const float width = ImGui::GetContentRegionAvail().x - buttons;
  if (editing_path_) {
    ImGui::SetNextItemWidth(width);
    if (focus_bottom_) ImGui::SetKeyboardFocusHere();
    const bool entered =
        text_input("##path", path_text_, "", ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    const bool left = ImGui::IsItemDeactivated() && !focus_bottom_;
    focus_bottom_ = false;
    if (entered)
      go_to_text(std::string(path_text_));
    else if (left)
      editing_path_ = false;
  } else {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(2), 0});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
    ImGui::BeginChild("crumbs", {width, ImGui::GetFrameHeight()}, false, ImGuiWindowFlags_NoScrollbar);
    draw_breadcrumbs();
    const bool clicked_beside = ImGui::IsWindowHovered() && ImGui::IsMouseClicked(0) && !ImGui::IsAnyItemHovered();
    ImGui::EndChild();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    if (clicked_beside) begin_path();
  }
  ImGui::SameLine();
  if (icon_button("type", Icon::search, "Type a path (Ctrl+L)")) begin_path();
  ImGui::SameLine();
  if (icon_button("refresh", Icon::reset, "Read the folder again (F5)")) refresh();
}

// The last folders of the path, as many as have room.
void FileBrowser::draw_breadcrumbs() {
  std::vector<fs::path> crumbs;
  for (fs::path path = folder_;; path = path.parent_path()) {
    crumbs.push_back(path);
    if (!path.has_relative_path()) break;
  }
  const auto label = [](const fs::path& path) {
    return path.has_relative_path() ? path.filename().string() : std::string("/");
  };
  const float padding = 2 * ImGui::GetStyle().FramePadding.x + scaled(10);
  float room = ImGui::GetContentRegionAvail().x - scaled(40);
  std::size_t count = 0;
  for (; count < crumbs.size(); ++count) {
    room -= ImGui::CalcTextSize(label(crumbs[count]).c_str()).x + padding;
    if (room < 0 && count > 0) break;
  }
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(0, 0, 0, 0));
  fs::path chosen;
  for (std::size_t i = count; i-- > 0;) {
    ImGui::PushID(static_cast<int>(i));
    const std::string text = elided(label(crumbs[i]), ImGui::GetContentRegionAvail().x - padding);
    if (ImGui::Button((text + "##crumb").c_str())) chosen = crumbs[i];
    ImGui::PopID();
    ImGui::SameLine(0, 0);
    if (i == 0 || !crumbs[i].has_relative_path()) continue;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("/");
    ImGui::SameLine(0, 0);
  }
  ImGui::PopStyleColor();
  if (!chosen.empty() && chosen != folder_) enter(chosen);
}

void FileBrowser::draw_places(float width, float height) {
  ImGui::BeginChild("places", {width, height});
  fs::path chosen;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const BrowserPlace& place = places_[i];
    if (icon_row(std::to_string(i).c_str(), Icon::folder, color::kQuiet, place.name, place.folder == folder_, width))
      chosen = place.folder;
    tooltip_for_item(place.folder.c_str());
  }
  ImGui::EndChild();
  if (!chosen.empty()) enter(chosen);
}

void FileBrowser::handle_sorting() {
  ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs == nullptr || !specs->SpecsDirty || specs->SpecsCount == 0) return;
  specs->SpecsDirty = false;
  const ListingOrder wanted{static_cast<SortBy>(specs->Specs[0].ColumnUserID),
                            specs->Specs[0].SortDirection == ImGuiSortDirection_Descending};
  if (wanted == order_) return;
  order_ = wanted;
  if (selected_ >= 0) select_when_read_ = shown_[static_cast<std::size_t>(selected_)].name;
  if (!reading_) refresh();
}

void FileBrowser::draw_row(int entry, bool with_size, bool with_time) {
  const FolderEntry& shown = shown_[static_cast<std::size_t>(entry)];
  const bool selected = entry == selected_;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float room = ImGui::GetContentRegionAvail().x;
  const float height = ImGui::GetTextLineHeight() + scaled(4);
  ImGui::PushID(entry);
  if (selected) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, IM_COL32(48, 84, 128, 255));
  if (ImGui::Selectable("##entry", false, ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick,
                        {0, height})) {
    select(entry);
    if (ImGui::IsMouseDoubleClicked(0)) activate(entry);
  }
  ImGui::PopID();
  ui_probe_->note_item("browser/" + shown.name);
  if (!open_ || entry >= static_cast<int>(shown_.size())) return;  // it was the answer, or another folder was entered
  if (selected && scroll_to_selected_) {
    ImGui::SetScrollHereY();
    scroll_to_selected_ = false;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_icon(list, shown.is_folder ? Icon::folder : Icon::file, {place.x + scaled(9), place.y + height / 2}, scaled(14),
            shown.is_folder ? color::kAccent : color::kQuiet);
  list.AddText({place.x + scaled(22), place.y + scaled(2)}, color::kText,
               elided(shown.name, room - scaled(24)).c_str());
  if (with_size) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", shown.is_folder ? "" : size_text(shown.bytes).c_str());
  }
  if (with_time) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", time_text(shown.changed).c_str());
  }
}

void FileBrowser::draw_list(float height) {
  const float width = ImGui::GetContentRegionAvail().x;
  const bool with_size = width > scaled(330);
  const bool with_time = width > scaled(460);
  const int columns = 1 + with_size + with_time;
  const std::string id = fmt::format("entries{}", columns);
  const bool drawn = ImGui::BeginTable(
      id.c_str(), columns,
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersOuter,
      {width, height});
  if (!drawn) return;
  const auto fixed = ImGuiTableColumnFlags_WidthFixed;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_DefaultSort, 0,
                          static_cast<ImGuiID>(SortBy::name));
  if (with_size) ImGui::TableSetupColumn("Size", fixed, scaled(80), static_cast<ImGuiID>(SortBy::size));
  if (with_time) ImGui::TableSetupColumn("Changed", fixed, scaled(140), static_cast<ImGuiID>(SortBy::changed));
  handle_sorting();
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown_.size()));
  if (scroll_to_selected_ && selected_ >= 0) clipper.ForceDisplayRangeByIndices(selected_, selected_ + 1);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < std::min(clipper.DisplayEnd, static_cast<int>(shown_.size())); ++i)
      draw_row(i, with_size, with_time);
  if (shown_.empty()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string& problem = reader_.listing().problem;
    if (reading_)
      ImGui::TextDisabled("Reading...");
    else if (problem.empty())
      ImGui::TextDisabled("Nothing of this kind is here.");
    else
      ImGui::TextWrapped("This folder cannot be read: %s", problem.c_str());
  }
  ImGui::EndTable();
}

void FileBrowser::draw_bottom() {
  draw_text(elided(problem_, ImGui::GetContentRegionAvail().x), color::kBad);
  if (bottom_ == Bottom::overwrite)
    draw_overwrite();
  else if (bottom_ == Bottom::new_folder)
    draw_new_folder();
  else
    draw_answer();
}

void FileBrowser::draw_filter(float width) {
  ImGui::SetNextItemWidth(width);
  const bool before = all_files_;
  const std::string text = filter_text(question_.extensions);
  if (ImGui::BeginCombo("##filter", all_files_ ? "All files" : text.c_str())) {
    if (!question_.extensions.empty() && ImGui::Selectable(text.c_str(), !all_files_)) all_files_ = false;
    if (ImGui::Selectable("All files", all_files_)) all_files_ = true;
    ImGui::EndCombo();
  }
  if (before != all_files_) refresh();
}

void FileBrowser::draw_answer() {
  const bool saving = question_.wanted == FileDialogMode::to_save;
  const bool of_folder = question_.wanted == FileDialogMode::folder;
  const float room = ImGui::GetContentRegionAvail().x;
  bool entered = false;
  if (saving) {
    if (focus_name_) ImGui::SetKeyboardFocusHere();
    focus_name_ = false;
    ImGui::SetNextItemWidth(room - scaled(210) - ImGui::GetStyle().ItemSpacing.x);
    entered = text_input("##name", name_, "name of the file", ImGuiInputTextFlags_EnterReturnsTrue);
    ui_probe_->note_item("browser/name");
    ImGui::SameLine();
  } else {
    const std::string chosen = selected_ >= 0 ? shown_[static_cast<std::size_t>(selected_)].name : std::string();
    const std::string text = of_folder ? (folder_ / chosen).string() : chosen;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", elided(text, room - scaled(220)).c_str());
    ImGui::SameLine(room - scaled(210) + ImGui::GetStyle().WindowPadding.x);
  }
  if (of_folder)
    ImGui::NewLine();
  else
    draw_filter(scaled(210));

  const char* main = saving ? "Save" : (of_folder ? "Choose" : "Open");
  if (saving || of_folder) {
    if (ui_probe_->noted(dialog_button("New folder"), "browser/new folder")) {
      bottom_ = Bottom::new_folder;
      new_folder_.clear();
      focus_bottom_ = true;
    }
    ImGui::SameLine();
  }
  align_buttons_right({"Cancel", main});
  if (ui_probe_->noted(dialog_button("Cancel"), "browser/cancel")) open_ = false;
  ImGui::SameLine();
  const bool can = saving ? !name_.empty() : of_folder || selected_ >= 0;
  const bool clicked = ui_probe_->noted(dialog_button(main, true, can), "browser/answer");
  if (clicked || entered) {
    if (saving)
      answer_by_name();
    else if (of_folder)
      answer_with(selected_ >= 0 ? folder_ / shown_[static_cast<std::size_t>(selected_)].name : folder_);
    else
      activate(selected_);
  }
}

void FileBrowser::draw_overwrite() {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(elided(name_ + " is there already. Replace it?", ImGui::GetContentRegionAvail().x).c_str());
  align_buttons_right({"Back", "Replace"});
  if (dialog_button("Back")) bottom_ = Bottom::answer;
  ImGui::SameLine();
  const bool clicked = ui_probe_->noted(dialog_button("Replace", true), "browser/replace");
  if (clicked) answer_by_name();
}

void FileBrowser::draw_new_folder() {
  if (focus_bottom_) ImGui::SetKeyboardFocusHere();
  focus_bottom_ = false;
  ImGui::SetNextItemWidth(-1);
  const bool entered =
      text_input("##new folder", new_folder_, "name of the new folder", ImGuiInputTextFlags_EnterReturnsTrue);
  align_buttons_right({"Back", "Make folder"});
  if (dialog_button("Back")) bottom_ = Bottom::answer;
  ImGui::SameLine();
  if (dialog_button("Make folder", true, !new_folder_.empty()) || entered) make_folder();
}

}  // namespace sigs::editor
