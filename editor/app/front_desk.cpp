// SPDX-License-Identifier: MIT
#include "editor/app/front_desk.h"

#include <algorithm>
#include <utility>

#include "editor/app/layout.h"
#include "editor/views/menu_bar.h"
#include "editor/views/viewport/readout.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTitle = 80;  // bytes

void add_place(std::vector<BrowserPlace>& places, std::string name, fs::path folder) {
  std::error_code code;
  folder = fs::absolute(folder, code).lexically_normal();
  const bool is_known =
      std::any_of(places.begin(), places.end(), [&](const BrowserPlace& place) { return place.folder == folder; });
  if (!folder.empty() && !is_known && fs::is_directory(folder, code)) places.push_back({std::move(name), folder});
}

// Where a person who works on this project probably wants to go.
std::vector<BrowserPlace> places_for(const Project& project, const Settings& settings, const fs::path& samples) {
  std::vector<BrowserPlace> places = usual_places();
  if (!project.file.empty()) add_place(places, "Project", project.file.parent_path());
  if (!project.footage.video.empty())
    add_place(places, "Footage", resolved(project, project.footage.video).parent_path());
  add_place(places, "Sample projects", samples);
  constexpr std::size_t kMostRecent = 4;
  for (std::size_t i = 0; i < std::min(kMostRecent, settings.recent.size()); ++i) {
    const fs::path folder = settings.recent[i].parent_path();
    add_place(places, folder.filename().string(), folder);
  }
  return places;
}

}  // namespace

FrontDesk::FrontDesk(Document& document, Settings& settings, Setup setup)
    : document_(document),
      settings_(settings),
      setup_(std::move(setup)),
      export_(setup_.wake),
      files_(document, settings,
             {.recovery_folder = setup_.recovery_folder,
              .wake = setup_.wake,
              .is_exporting = [this] { return export_.is_running(); },
              .mask = setup_.mask,
              .is_asking_for_file = [this] { return browser_.is_open(); }}),
      start_page_(setup_.samples, setup_.wake) {
  const fs::path usual = settings.recent.empty() ? setup_.samples : settings.recent.front().parent_path();
  browser_.set_folder(settings.last_folder.empty() ? usual : settings.last_folder);
}

bool FrontDesk::is_restless() const {
  return export_.is_running() || toasts_.is_passing() || !files_.loading().empty() || browser_.is_open();
}

// One after the other: the later waits until the browser is closed.
void FrontDesk::ask_for_files() {
  if (browser_.is_open() || files_wanted_.empty()) return;
  const AskForFile wanted = std::move(files_wanted_.front());
  files_wanted_.pop_front();
  const FileWanted kind =
      wanted.of_folder ? FileWanted::folder : (wanted.for_saving ? FileWanted::to_save : FileWanted::to_open);
  chosen_ = wanted.chosen;
  browser_.ask({shortened(wanted.title, kMostTitle), wanted.of_folder ? std::vector<std::string>() : wanted.extensions,
                kind, wanted.start},
               places_for(document_.project(), settings_, setup_.samples));
}

bool FrontDesk::take(const Request& request) {
  if (files_.take(request)) return true;
  if (const auto* wanted = std::get_if<AskForFile>(&request)) {
    files_wanted_.push_back(*wanted);
    ask_for_files();
  } else if (const auto* message = std::get_if<Say>(&request)) {
    toasts_.say(*message, now_s_);
  } else if (std::holds_alternative<ClearMessages>(request)) {
    toasts_.clear();
  } else if (std::holds_alternative<ShowExport>(request)) {
    if (has_project()) export_view_.open(document_);
  } else if (std::holds_alternative<ShowMissingFiles>(request)) {
    if (has_project()) relink_.open(document_.project());
  } else if (std::holds_alternative<ShowSettings>(request)) {
    shows_settings_ = true;
  } else if (std::holds_alternative<ShowHelp>(request)) {
    shows_help_ = true;
  } else if (std::holds_alternative<ShowAbout>(request)) {
    shows_about_ = true;
  } else {
    return false;
  }
  return true;
}

void FrontDesk::take_own_requests() {
  for (const Request& request : files_.take_requests()) take(request);
}

// Who went on with other things meanwhile is not interrupted.
void FrontDesk::tell_of_export() {
  if (export_view_.is_open()) return;
  const ExportState state = export_.state();
  if (state.phase == ExportPhase::done)
    toasts_.say({"Exported into " + state.request.folder.string() + "; Ctrl + E shows it"}, now_s_);
  if (state.phase == ExportPhase::failed) toasts_.say({"The export failed; Ctrl + E shows why", true}, now_s_);
}

void FrontDesk::turn(double now_s) {
  now_s_ = now_s;
  for (const auto& step : std::exchange(answered_, {})) step();
  files_.turn(now_s);
  take_own_requests();
  ask_for_files();
  if (std::exchange(project_file_, document_.project().file) != document_.project().file) export_view_.forget_folder();
  const bool exporting = export_.is_running();
  if (std::exchange(was_exporting_, exporting) && !exporting) tell_of_export();
}

void FrontDesk::draw_menu(const Studio& studio) {
  draw_menu_bar(studio, {.has_project = has_project(), .exporting = export_.state()}, settings_);
}

void FrontDesk::draw_start_page(const Studio& studio) {
  const StartPageChoice choice =
      start_page_.draw(studio, {.abandoned = files_.abandoned(), .loading = files_.loading()});
  if (choice.recover) answered_.emplace_back([this, project = *choice.recover] { files_.recover(project); });
  if (choice.discard) answered_.emplace_back([this, project = *choice.discard] { files_.discard(project); });
}

// One at a time; what has to be answered first comes first.
void FrontDesk::draw_dialog(const Studio& studio) {
  if (files_.question()) {
    if (const std::optional<int> answer = draw_question(*files_.question(), studio.places))
      answered_.emplace_back([this, number = *answer] { files_.answer(number); });
  } else if (browser_.is_open()) {
    const std::optional<fs::path> path = browser_.draw(studio.places);
    settings_.last_folder = browser_.folder();
    if (path && chosen_) answered_.emplace_back([chosen = std::exchange(chosen_, nullptr), path] { chosen(*path); });
  } else if (relink_.is_open()) {
    relink_.draw(studio);
  } else if (export_view_.is_open()) {
    export_view_.draw(studio, export_);
  } else if (shows_settings_) {
    shows_settings_ = settings_dialog_.draw(settings_, studio.places);
  } else if (shows_help_) {
    shows_help_ = draw_help(setup_.help, studio.places);
  } else if (shows_about_) {
    shows_about_ = draw_about(setup_.version, studio.places);
  }
}

void FrontDesk::draw_over_all(const Studio& studio) {
  draw_dialog(studio);
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  const float inspector = has_project() && settings_.show_inspector ? scaled(settings_.inspector_width) : 0;
  // Neither the timeline nor what is read off the picture above it is covered.
  const float below =
      has_project() ? Layout::timeline_height_px(settings_, screen.WorkSize.y) + readout_height() + scaled(6) : 0;
  const float width = screen.Size.x - inspector;
  toasts_.draw(studio.places, now_s_, {screen.Pos.x + width / 2, screen.Pos.y + screen.Size.y - below - scaled(18)},
               width);
}

}  // namespace sigs::editor
