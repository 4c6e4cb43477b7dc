// SPDX-License-Identifier: MIT
#include "editor/views/dialogs.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "editor/views/export_view.h"
#include "editor/views/viewport/cameras_view.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

// An item that is known by name to whoever drives the window from outside.
bool item(const ViewContext& context, const char* label, const char* keys, bool enabled = true, bool checked = false) {
  const bool chosen =
      context.ui_probe.noted(ImGui::MenuItem(label, keys, checked, enabled), std::string("menu/") + label);
  return chosen;
}

bool begin_menu(const ViewContext& context, const char* label) {
  const bool open = ImGui::BeginMenu(label);
  if (!open) context.ui_probe.note_item(std::string("menu/") + label);
  if (open && pressed(Key::escape)) ImGui::CloseCurrentPopup();
  return open;
}

void draw_recent(const ViewContext& context) {
  if (!ImGui::BeginMenu("Open recent", !context.settings.recent.empty())) return;
  for (const std::filesystem::path& path : context.settings.recent) {
    ImGui::PushID(path.c_str());
    if (ImGui::MenuItem(elided(path.stem().string(), scaled(300)).c_str())) context.edits.ask(OpenProject{path});
    tooltip_for_item(path.c_str());
    ImGui::PopID();
  }
  ImGui::EndMenu();
}

void draw_file_menu(const ViewContext& context, bool has_project) {
  if (!begin_menu(context, "File")) return;
  Edits& edits = context.edits;
  if (item(context, "New...", "Ctrl+N")) edits.ask(ShowNewProject{});
  if (item(context, "Open...", "Ctrl+O")) edits.ask(OpenProject{});
  draw_recent(context);
  ImGui::Separator();
  if (item(context, "Save", "Ctrl+S", has_project)) edits.ask(SaveProject{});
  if (item(context, "Save as...", "Ctrl+Shift+S", has_project)) edits.ask(SaveProjectAs{});
  if (item(context, "Export...", "Ctrl+E", has_project)) edits.ask(ShowExport{});
  if (item(context, "Find missing files...", "", has_project)) edits.ask(ShowMissingFiles{});
  if (item(context, "Load tracker results...", "", has_project)) edits.ask(LoadResults{});
  ImGui::Separator();
  if (item(context, "Close project", "", has_project)) edits.ask(CloseProject{});
  if (item(context, "Quit", "Ctrl+Q")) edits.ask(Quit{});
  ImGui::EndMenu();
}

void draw_edit_menu(const ViewContext& context, bool has_project) {
  if (!begin_menu(context, "Edit")) return;
  const Document& document = context.document;
  const std::string undo = fmt::format("Undo {}###Undo", document.undo_name());
  const std::string redo = fmt::format("Redo {}###Redo", document.redo_name());
  if (context.ui_probe.noted(ImGui::MenuItem(undo.c_str(), "Ctrl+Z", false, document.can_undo()), "menu/Undo"))
    context.edits.undo();
  if (context.ui_probe.noted(ImGui::MenuItem(redo.c_str(), "Ctrl+Y", false, document.can_redo()), "menu/Redo"))
    context.edits.redo();
  ImGui::Separator();
  const bool on_waypoint = document.selection().kind == Selected::waypoint;
  const bool on_intruder = on_waypoint || document.selection().kind == Selected::intruder;
  if (item(context, "Add camera...", "", has_project)) ask_add_camera(context);
  if (item(context, "Remove camera", "", document.active_camera() > 0)) ask_remove_camera(context);
  ImGui::Separator();
  if (item(context, "Own body...", "", has_project)) context.edits.ask(ShowOwnBody{});
  const bool estimates = context.ego_motion != nullptr && context.ego_motion->is_running();
  if (item(context, "Estimate camera motion", "", has_project && !estimates)) context.edits.ask(EstimateCameraMotion{});
  if (estimates && item(context, "Stop estimating camera motion", "")) context.edits.ask(StopCameraMotion{});
  const bool matches_footage = context.appearance != nullptr && context.appearance->is_running();
  if (item(context, "Match the footage", "", has_project && !matches_footage)) context.edits.ask(MatchFootage{});
  if (matches_footage && item(context, "Stop matching the footage", "")) context.edits.ask(StopMatchingFootage{});
  const bool looks_at_light = context.light != nullptr && context.light->is_running();
  if (item(context, "Lit like this...", "", has_project && !looks_at_light)) context.edits.ask(ShowLightLike{});
  if (looks_at_light && item(context, "Stop finding the light", "")) context.edits.ask(StopLightLike{});
  ImGui::Separator();
  if (item(context, "Add waypoint here", "Enter", has_project && !context.project().intruders.empty()))
    add_waypoint_here(context);
  if (item(context, "Duplicate", "Ctrl+D", on_waypoint)) duplicate_selected(context);
  if (item(context, "Delete", "Del", on_intruder)) delete_selected(context);
  ImGui::EndMenu();
}

void draw_view_menu(const ViewContext& context, Settings& settings) {
  if (!begin_menu(context, "View")) return;
  if (item(context, "World view", "", true, settings.show_world)) settings.show_world = !settings.show_world;
  if (item(context, "Inspector", "", true, settings.show_inspector)) settings.show_inspector = !settings.show_inspector;
  if (item(context, "All cameras", "A", context.document.cameras().size() > 1)) context.edits.ask(ToggleAllCameras{});
  if (item(context, "Full screen", "F11")) context.edits.ask(ToggleFullScreen{});
  ImGui::Separator();
  if (item(context, "Settings...", "")) context.edits.ask(ShowSettings{});
  ImGui::EndMenu();
}

void draw_help_menu(const ViewContext& context) {
  if (!begin_menu(context, "Help")) return;
  if (item(context, "Keys", "?")) context.edits.ask(ShowHelp{});
  if (item(context, "About", "")) context.edits.ask(ShowAbout{});
  ImGui::EndMenu();
}

// From right to left; each takes its room.
class RightSide {
 public:
  explicit RightSide(const ViewContext& context)
      : context_(context), left_(ImGui::GetCursorPosX() + scaled(12)), right_(ImGui::GetWindowWidth() - scaled(12)) {}

  void show_export(const ExportState& state) {
    if (!state.is_running()) return;
    const double share = share_done(state.done, state.total);
    if (show_progress("export progress", short_progress_text(state), share, "Show the export"))
      context_.edits.ask(ShowExport{});
  }

  // Of an estimate in the background, wherever its panel is.
  template <class State>
  void show_estimate(const char* id, const std::string& what, const State* state) {
    if (state == nullptr || !state->is_running()) return;
    const double share = share_done(state->done, state->total);
    const std::string text = state->is_stopping ? what + ", stopping" : fmt::format("{} {:.0f} %", what, 100 * share);
    (void)show_progress(id, text, share, "Goes on in the background; the menu Edit stops it");
  }

  void show_problems(const std::vector<Problem>& problems) {
    if (problems.empty()) return;
    const bool is_missing =
        std::ranges::any_of(problems, [](const Problem& problem) { return problem.kind == ErrorKind::cannot_read; });
    const std::string text = count_text(std::ssize(problems), "problem");
    const float width = ImGui::CalcTextSize(text.c_str()).x + scaled(24);
    if (!take(width)) return;
    const ImVec2 place = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    if (context_.ui_probe.noted(ImGui::InvisibleButton("problems", {width, height}), "menu/problems") && is_missing)
      context_.edits.ask(ShowMissingFiles{});
    if (ImGui::IsItemHovered()) show_list(problems);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_icon(list, Icon::warning, {place.x + scaled(9), place.y + height / 2}, scaled(13), color::kPartly);
    list.AddText({place.x + scaled(20), place.y + (height - ImGui::GetTextLineHeight()) / 2}, color::kPartly,
                 text.c_str());
  }

  void show_name() {
    const Project& project = context_.project();
    const bool unsaved = context_.document.has_unsaved_changes();
    const std::string whole = project.file.empty() ? project.name + " (never saved)" : project.file.stem().string();
    const float dot = scaled(14);
    const std::string text = elided(whole, right_ - left_ - dot);
    if (text.empty()) return;
    const float width = ImGui::CalcTextSize(text.c_str()).x + (unsaved ? dot : 0);
    const float middle = (ImGui::GetWindowWidth() - width) / 2;
    ImGui::SetCursorPosX(std::clamp(middle, left_, std::max(left_, right_ - width)));
    const ImVec2 place = ImGui::GetCursorScreenPos();
    ImGui::TextUnformatted(text.c_str());
    if (!project.file.empty()) tooltip_for_item(project.file.c_str());
    if (unsaved)
      ImGui::GetWindowDrawList()->AddCircleFilled({place.x + width - scaled(4), place.y + ImGui::GetFrameHeight() / 2},
                                                  scaled(3.5), color::kAccent, 12);
  }

 private:
  // A bar behind a text; true when it is clicked.
  bool show_progress(const char* id, const std::string& text, double share, const char* tooltip) {
    const float width = ImGui::CalcTextSize(text.c_str()).x + scaled(20);
    if (!take(width)) return false;
    const ImVec2 place = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    const bool is_clicked =
        context_.ui_probe.noted(ImGui::InvisibleButton(id, {width, height}), std::string("menu/") + id, tooltip);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float inset = scaled(3);
    const ImVec2 low{place.x, place.y + inset};
    list.AddRectFilled(low, {low.x + width, place.y + height - inset}, IM_COL32(255, 255, 255, 22), scaled(4));
    list.AddRectFilled(low, {low.x + static_cast<float>(width * share), place.y + height - inset}, color::kAccentSoft,
                       scaled(4));
    list.AddText({place.x + scaled(10), place.y + (height - ImGui::GetTextLineHeight()) / 2}, color::kText,
                 text.c_str());
    return is_clicked;
  }

  bool take(float width) {
    if (right_ - width < left_) return false;
    right_ -= width;
    ImGui::SetCursorPosX(right_);
    right_ -= scaled(12);
    return true;
  }

  static void show_list(const std::vector<Problem>& problems) {
    constexpr std::size_t kMax = 12;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(scaled(480));
    for (std::size_t i = 0; i < std::min(kMax, problems.size()); ++i)
      ImGui::TextUnformatted(shortened(problems[i].field + ": " + problems[i].what, 400).c_str());
    if (problems.size() > kMax) ImGui::TextUnformatted("...");
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }

  const ViewContext& context_;
  float left_;
  float right_;
};

}  // namespace

void draw_menu_bar(const ViewContext& context, bool has_project, const ExportState& exporting, Settings& settings) {
  if (!ImGui::BeginMainMenuBar()) return;
  draw_file_menu(context, has_project);
  draw_edit_menu(context, has_project);
  draw_view_menu(context, settings);
  draw_help_menu(context);
  RightSide right(context);
  right.show_export(exporting);
  right.show_estimate("camera motion progress", "Camera motion", context.ego_motion);
  right.show_estimate("matching progress", "Matching the footage", context.appearance);
  right.show_estimate("light progress", "Finding the light", context.light);
  if (has_project) {
    if (context.shown.scene) right.show_problems(context.shown.scene->draft.problems);
    right.show_name();
  }
  ImGui::EndMainMenuBar();
}

}  // namespace sigs::editor
