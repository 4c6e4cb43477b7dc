// SPDX-License-Identifier: MIT
#include "editor/app/app_shell.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "base/text.h"
#include "editor/app/layout.h"
#include "editor/document/project_paths.h"
#include "editor/views/viewport/viewport_view.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTitle = 80;  // bytes

void add_place(std::vector<BrowserPlace>& places, std::string name, fs::path folder) {
  std::error_code code;
  folder = fs::absolute(folder, code).lexically_normal();
  const bool is_known = std::ranges::any_of(places, [&](const BrowserPlace& place) { return place.folder == folder; });
  if (!folder.empty() && !is_known && fs::is_directory(folder, code)) places.push_back({std::move(name), folder});
}

// The folder in which somebody started the program by name; none where a desktop did, which starts all in one folder.
std::optional<fs::path> started_in() {
  std::error_code code;
  const fs::path folder = fs::current_path(code);
  const char* const home = std::getenv("HOME");
  if (code || folder == folder.root_path() || (home != nullptr && folder == fs::path(home))) return std::nullopt;
  return folder;
}

// Where a person who works on this project probably wants to go.
std::vector<BrowserPlace> places_for(const Project& project, const Settings& settings, const fs::path& samples) {
  std::vector<BrowserPlace> places = usual_places();
  if (!project.file.empty()) add_place(places, "Project", project.file.parent_path());
  if (!project.footage.video.empty())
    add_place(places, "Footage", resolved(project, project.footage.video).parent_path());
  add_place(places, "Sample projects", samples);
  constexpr std::size_t kMaxRecent = 4;
  for (std::size_t i = 0; i < std::min(kMaxRecent, settings.recent.size()); ++i) {
    const fs::path folder = settings.recent[i].parent_path();
    add_place(places, folder.filename().string(), folder);
  }
  return places;
}

// Where a project goes that cannot lie beside its video.
fs::path writable_folder(const Settings& settings) {
  std::vector<fs::path> folders;
  if (!settings.recent.empty()) folders.push_back(settings.recent.front().parent_path());
  folders.push_back(settings.last_folder);
  if (const char* const home = std::getenv("HOME")) folders.emplace_back(home);
  for (const fs::path& folder : folders) {
    std::error_code code;
    if (fs::is_directory(folder, code) && ::access(folder.c_str(), W_OK) == 0) return folder;
  }
  std::error_code code;
  return fs::current_path(code);
}

std::vector<Guess> guesses_of(const fs::path& project_file) {
  std::vector<Guess> guesses;
  for (FirstProjectGuess& guess : guesses_beside(project_file))
    guesses.push_back({{std::move(guess.field), std::move(guess.text)}, std::move(guess.value)});
  return guesses;
}

// Where the intruder is largest of all frames in which it is in view; none where it is in view at `first` already, or
// nowhere.
std::optional<int> best_frame(const Survey& survey, int first) {
  const VisibilityEstimate* best = nullptr;
  for (const VisibilityEstimate& estimate : survey.estimates) {
    if (estimate.visibility_state != VisibilityState::in_view) continue;
    if (estimate.frame == first) return std::nullopt;
    if (best == nullptr || estimate.size_px > best->size_px) best = &estimate;
  }
  return best != nullptr ? std::optional(best->frame) : std::nullopt;
}

}  // namespace

AppShell::AppShell(Document& document, Settings& settings, Setup setup)
    : document_(document),
      settings_(settings),
      setup_(std::move(setup)),
      export_(setup_.wake, exported),
      session_(document, settings,
               {.recovery_folder = setup_.recovery_folder,
                .wake = setup_.wake,
                .is_exporting = [this] { return export_.is_running(); },
                .mask = setup_.mask,
                .is_asking_for_file = [this] { return browser_.is_open(); }}),
      gallery_(setup_.models, setup_.wake),
      new_project_(document, settings, session_, gallery_, setup_.wake),
      change_model_(gallery_, setup_.wake),
      start_page_(setup_.samples, setup_.wake) {
  // The samples are among the places that the browser offers.
  const char* const home = std::getenv("HOME");
  const fs::path first = home != nullptr ? fs::path(home) : setup_.samples;
  const fs::path usual = settings.recent.empty() ? first : settings.recent.front().parent_path();
  const fs::path last = settings.last_folder.empty() ? usual : settings.last_folder;
  browser_.set_folder(started_in().value_or(last));
}

bool AppShell::needs_redraw() const {
  return export_.is_running() || toasts_.is_passing() || !session_.loading().empty() || browser_.is_open();
}

// One after the other: the later waits until the browser is closed.
void AppShell::ask_for_files() {
  if (browser_.is_open() || files_wanted_.empty()) return;
  const AskForFile wanted = std::move(files_wanted_.front());
  files_wanted_.pop_front();
  const FileDialogMode kind = wanted.of_folder
                                  ? FileDialogMode::folder
                                  : (wanted.for_saving ? FileDialogMode::to_save : FileDialogMode::to_open);
  chosen_ = wanted.chosen;
  browser_.ask({shortened(wanted.title, kMaxTitle), wanted.of_folder ? std::vector<std::string>() : wanted.extensions,
                kind, wanted.start},
               places_for(document_.project(), settings_, setup_.samples));
}

bool AppShell::handle(const Request& request) {
  if (session_.handle(request)) return true;
  if (const auto* wanted = std::get_if<AskForFile>(&request)) {
    files_wanted_.push_back(*wanted);
    ask_for_files();
  } else if (const auto* message = std::get_if<ShowMessage>(&request)) {
    toasts_.show(*message, now_s_);
  } else if (std::holds_alternative<ClearMessages>(request)) {
    toasts_.clear();
  } else if (const auto* wanted_project = std::get_if<ShowNewProject>(&request)) {
    new_project_.open(wanted_project->video);
  } else if (std::holds_alternative<ShowExport>(request)) {
    if (has_project()) export_view_.open(document_);
  } else if (std::holds_alternative<ShowMissingFiles>(request)) {
    if (has_project()) relink_.open(document_.whole());
  } else if (const auto* models = std::get_if<ShowModels>(&request)) {
    if (has_project()) change_model_.open(document_.project(), models->intruder);
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

void AppShell::handle_dropped(const fs::path& path, Edits& edits) {
  if (new_project_.is_open())
    new_project_.take_dropped(path);
  else if (!has_project() && classified_drop(path).kind == DroppedKind::video)
    new_project_.open(path);
  else
    session_.handle_dropped(path, edits);
}

// Who went on with other things meanwhile is not interrupted.
void AppShell::report_export() {
  if (export_view_.is_open()) return;
  const ExportState state = export_.state();
  if (state.phase == JobPhase::done)
    toasts_.show({fmt::format("Exported into {}; Ctrl + E shows it", state.request.folder.string())}, now_s_);
  if (state.phase == JobPhase::failed) toasts_.show({"The export failed; Ctrl + E shows why", true}, now_s_);
}

void AppShell::update(double now_s) {
  now_s_ = now_s;
  for (const auto& step : std::exchange(answered_, {})) step();
  session_.update(now_s);
  new_project_.update();
  for (const Request& request : session_.take_requests()) handle(request);
  for (const Request& request : new_project_.take_requests()) handle(request);
  ask_for_files();
  if (std::exchange(project_file_, document_.project().file) != document_.project().file) export_view_.forget_folder();
  if (has_project()) start_page_.rest();
  const bool exporting = export_.is_running();
  if (std::exchange(was_exporting_, exporting) && !exporting) report_export();
}

void AppShell::draw_menu(const ViewContext& context) {
  draw_menu_bar(context, has_project(), export_.state(), settings_);
}

void AppShell::draw_start_page(const ViewContext& context) {
  const StartPageChoice choice = start_page_.draw(context, session_.abandoned(), session_.loading());
  if (choice.recover) answered_.emplace_back([this, project = *choice.recover] { session_.recover(project); });
  if (choice.discard) answered_.emplace_back([this, project = *choice.discard] { session_.discard(project); });
}

// One at a time; what has to be answered first comes first.
void AppShell::draw_dialog(const ViewContext& context) {
  if (session_.question()) {
    if (const std::optional<int> answer = draw_question(*session_.question(), context.ui_probe))
      answered_.emplace_back([this, number = *answer] { session_.answer(number); });
  } else if (browser_.is_open()) {
    const std::optional<fs::path> path = browser_.draw(context.ui_probe);
    settings_.last_folder = browser_.folder();
    if (path && chosen_) answered_.emplace_back([chosen = std::exchange(chosen_, nullptr), path] { chosen(*path); });
  } else if (new_project_.is_open()) {
    new_project_.draw(context);
  } else if (change_model_.is_open()) {
    change_model_.draw(context);
  } else if (relink_.is_open()) {
    relink_.draw(context);
  } else if (export_view_.is_open()) {
    export_view_.draw(context, export_);
  } else if (shows_settings_) {
    shows_settings_ = settings_dialog_.draw(settings_, context.ui_probe);
  } else if (shows_help_) {
    shows_help_ = draw_help(setup_.help, context.ui_probe);
  } else if (shows_about_) {
    shows_about_ = draw_about(setup_.version, context.ui_probe);
  }
}

void AppShell::draw_over_all(const ViewContext& context) {
  new_project_.look(context);
  draw_dialog(context);
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  const float inspector = has_project() && settings_.show_inspector ? scaled(settings_.inspector_width) : 0;
  // Neither the timeline nor what is read off the image above it is covered.
  const float below =
      has_project() ? Layout::timeline_height_px(settings_, screen.WorkSize.y) + readout_height() + scaled(6) : 0;
  const float width = screen.Size.x - inspector;
  toasts_.draw(context.ui_probe, now_s_, {screen.Pos.x + width / 2, screen.Pos.y + screen.Size.y - below - scaled(18)},
               width);
}

NewProjectFlow::NewProjectFlow(Document& document, Settings& settings, ProjectSession& session, ModelGallery& gallery,
                               std::function<void()> wake)
    : document_(document), settings_(settings), session_(session), dialog_(gallery, wake), job_(std::move(wake)) {}

void NewProjectFlow::open(const fs::path& video) {
  if (job_.is_running()) return;
  job_.forget();
  made_ = nullptr;
  dialog_.open(video, writable_folder(settings_));
}

void NewProjectFlow::take_made() {
  const FirstProjectState state = job_.state();
  if (state.phase != JobPhase::done || state.value == made_) return;
  made_ = state.value;
  awaited_ = made_;
  document_number_ = 0;
  first_shown_.reset();
  dialog_.close();
  session_.open_agreed(made_->project.file);
}

void NewProjectFlow::begin_project() {
  document_number_ = document_.first_number();
  settings_.show_inspector = true;
  document_.apply(Select{{Selected::intruder, 0, 0}});
  const auto count = static_cast<std::int64_t>(guesses_.left().size());
  const std::string guessed =
      count > 0 ? fmt::format("; {} guessed, listed in the inspector", count_text(count, "setting")) : "";
  requests_.emplace_back(ShowMessage{"Made " + awaited_->project.file.filename().string() + guessed});
  for (const Warning& warning : awaited_->warnings) requests_.emplace_back(ShowMessage{warning.text()});
}

bool NewProjectFlow::goes_to_intruder() {
  if (document_.frame_count() == 0) return false;
  if (!first_shown_) {
    document_.apply(GoToFrame{(document_.first_frame() + document_.last_frame()) / 2});
    first_shown_ = document_.playhead();
  }
  // The person has gone on.
  if (document_.playhead() != *first_shown_ || document_.has_unsaved_changes()) return true;
  const auto frames = static_cast<std::size_t>(document_.last_frame() - document_.first_frame() + 1);
  if (!survey_ || survey_->revision < document_number_ || survey_->estimates.size() < frames) return false;
  if (const std::optional<int> frame = best_frame(*survey_, *first_shown_)) document_.apply(GoToFrame{*frame});
  return true;
}

void NewProjectFlow::follow_made() {
  if (!awaited_) return;
  const bool is_open = document_.project().file == awaited_->project.file;
  const bool is_awaited = !session_.loading().empty() || session_.question();
  if (document_number_ == 0 && is_open && !is_awaited) begin_project();
  const bool is_gone = document_number_ == 0 ? !is_awaited : document_.first_number() != document_number_;
  if (is_gone || (document_number_ != 0 && goes_to_intruder())) awaited_ = nullptr;
}

void NewProjectFlow::update() {
  const NewProjectChoice choice = std::exchange(choice_, {});
  if (choice.empty) session_.handle(NewProject{});
  if (choice.cancel) job_.cancel();
  if (choice.create)
    session_.replace_then([this, options = *choice.create] {
      if (job_.start(options)) dialog_.tell_end();
    });
  take_made();
  if (std::exchange(guesses_of_, document_.first_number()) != document_.first_number())
    guesses_.begin(guesses_of(document_.project().file), document_);
  guesses_.follow(document_);
  follow_made();
}

}  // namespace sigs::editor
