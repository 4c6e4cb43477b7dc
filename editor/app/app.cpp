// SPDX-License-Identifier: MIT
#include "editor/app/app.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "editor/app/shortcuts.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/popups.h"
#include "project/json.h"

namespace sigs::editor {

namespace {

constexpr double kIdle_s = 0.25;   // between turns while nothing happens
constexpr int kTurnsToSettle = 3;  // ImGui needs some turns to show all that an event leads to

std::vector<HelpLine> help_lines() {
  std::vector<HelpLine> lines;
  for (const Shortcut& shortcut : shortcuts()) lines.push_back({shortcut.group, shortcut.keys, shortcut.what});
  return lines;
}

}  // namespace

App::App(Window& window, Settings settings, Probe probe)
    : window_(window),
      settings_(std::move(settings)),
      probe_(std::move(probe)),
      previewer_(PreviewLimits(), [] { Window::wake(); }),
      own_body_(edits_, [] { Window::wake(); }),
      scoring_([] { Window::wake(); }),
      desk_(document_, settings_,
            {.samples = SIGS_PROJECTS_DIR,
             .recovery_folder = recovery_folder(),
             .version = SIGS_VERSION,
             .help = help_lines(),
             .wake = [] { Window::wake(); },
             .mask = {.unsaved = [this] { return own_body_.unsaved(); },
                      .save_then = [this](std::function<void()> next) { keep_mask_then(std::move(next)); },
                      .to_keep = [this] { return own_body_.to_keep(); }}}) {
  places_.set_wanted(probe_.wanted());
}

// What comes next has to see the edit that uses the mask: it is not saved either.
void App::keep_mask_then(std::function<void()> next) {
  own_body_.ask_keep(document_.project(), [this, next = std::move(next)] {
    take_edits();
    next();
  });
}

void App::open(const std::filesystem::path& path) {
  desk_.take(OpenProject{path});
}

double App::patience_s() const {
  if (playback_.playing() || restless_turns_ > 0) return 0;
  return desk_.is_restless() ? 0.1 : kIdle_s;
}

void App::ask_preview() {
  previewer_.want({.revision = document_.revision(),
                   .frame = document_.playhead(),
                   .direction = playback_.speed() < 0 ? -1 : 1,
                   .range_first = document_.range_first(),
                   .range_last = document_.range_last(),
                   .playing = playback_.playing(),
                   .footage = wishes_.footage,
                   .stages = wishes_.stages,
                   .compare_with = wishes_.compare_with,
                   .turntable = wishes_.turntable});
}

void App::advance(const Shown& shown) {
  if (!playback_.playing() || !shown.scene) return;
  const FootageShape& shape = shown.scene->footage->shape;
  const PlayedFrame due = playback_.frame_at(now_s_, {shape.times_s, shape.frame_interval_s},
                                             {document_.range_first(), document_.range_last(), settings_.loop});
  document_.apply(Edit(GoToFrame{due.frame}));
  if (due.over) playback_.pause();
}

void App::take_edits() {
  const int playhead = document_.playhead();
  document_.apply(edits_.take_edits());
  // Scrubbed while it plays: on from there.
  if (document_.playhead() != playhead && playback_.playing())
    playback_.play(now_s_, document_.playhead(), playback_.speed());
}

void App::play(double speed) {
  if (speed == 0)
    playback_.pause();
  else
    playback_.play(now_s_, document_.playhead(), speed);
}

void App::draw(const Shown& shown) {
  wishes_ = {};
  places_.clear();
  // A key that ends a dialog or a menu in this turn was meant for that.
  const bool keys_are_taken = any_popup_open();
  close_popup_with_escape();
  const Studio studio{.document = document_,
                      .shown = shown,
                      .settings = settings_,
                      .textures = textures_,
                      .edits = edits_,
                      .wishes = wishes_,
                      .places = places_,
                      .playing = playback_.playing(),
                      .speed = playback_.speed(),
                      .scored = scored_.get()};
  ask_scores(studio);
  desk_.draw_menu(studio);
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(screen.WorkPos);
  ImGui::SetNextWindowSize(screen.WorkSize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::Begin("SIGS", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar(2);
  if (desk_.has_project())
    layout_.draw(studio, own_body_, settings_);
  else
    desk_.draw_start_page(studio);
  ImGui::End();
  desk_.draw_over_all(studio);
  if (!keys_are_taken) take_keys(studio, desk_.has_project());
}

void App::ask_scores(const Studio& studio) {
  if (results_.files().empty()) {
    scoring_.want({});
    return;
  }
  scoring_.want({.scene = studio.shown.scene,
                 .surveys = studio.shown.surveys,
                 .files = results_.files(),
                 .intruder = current_intruder(studio).value_or(0)});
}

// What is wrong with a file is told once, when it is known what it is measured by: which frame a tracker was started in
// may hang on that.
void App::tell_of_results() {
  if (!scored_) {
    told_problems_.clear();
    return;
  }
  if (scored_->truth != TruthKind::measured && scored_->truth_problem.empty()) return;
  for (const ScoredTracker& tracker : scored_->trackers) {
    std::string& told = told_problems_[tracker.file.id];
    if (tracker.problem != told && !tracker.problem.empty()) edits_.ask(Say{tracker.problem, true});
    told = tracker.problem;
  }
}

bool App::take_results(const Request& request) {
  if (const auto* wanted = std::get_if<LoadResults>(&request)) {
    if (!desk_.has_project()) return true;
    if (wanted->path.empty()) {
      const std::filesystem::path near =
          results_.files().empty() ? document_.project().file : results_.files().back().path;
      edits_.ask(AskForFile{.title = "Load a tracker's results",
                            .extensions = {".txt", ".csv", ".json"},
                            .start = near.parent_path() / "",
                            .chosen = [this](const std::filesystem::path& path) { edits_.ask(LoadResults{path}); }});
    } else {
      results_.add(wanted->path);
      settings_.show_inspector = true;
    }
  } else if (const auto* gone = std::get_if<RemoveResults>(&request)) {
    results_.remove(gone->id);
  } else if (const auto* look = std::get_if<ShowResults>(&request)) {
    results_.set_shown(look->id, look->shown);
  } else {
    return false;
  }
  return true;
}

void App::take(const Request& request) {
  if (take_results(request) || desk_.take(request)) return;
  if (std::holds_alternative<ToggleFullScreen>(request)) window_.toggle_full_screen();
  if (std::holds_alternative<ShowOwnBody>(request)) layout_.show_own_body();
  if (std::holds_alternative<ShowHorizon>(request)) layout_.show_horizon();
  if (const auto* wanted = std::get_if<Play>(&request)) play(wanted->speed);
  if (std::holds_alternative<TogglePlay>(request)) play(playback_.playing() ? 0 : 1);
  if (const auto* loop = std::get_if<SetLoop>(&request)) settings_.loop = loop->loop;
}

void App::show_title() {
  const Project& project = document_.project();
  const std::string name = project.file.empty() ? project.name : project.file.filename().string();
  const std::string title =
      !desk_.has_project() ? "SIGS" : name + (document_.has_unsaved_changes() ? " * - SIGS" : " - SIGS");
  if (title != title_) window_.set_title(shortened(title, 200));
  title_ = title;
}

void App::count_turns() {
  ++turns_;
  if (now_s_ - counted_since_s_ < 1) return;
  turns_a_second_ = turns_ / (now_s_ - counted_since_s_);
  turns_ = 0;
  counted_since_s_ = now_s_;
}

void App::turn(double now_s, bool something_happened) {
  now_s_ = now_s;
  restless_turns_ = something_happened ? kTurnsToSettle : std::max(0, restless_turns_ - 1);
  count_turns();
  Shown shown = previewer_.shown();
  // What is still there of a project that was closed.
  if (shown.scene && shown.scene->revision < document_.first_number()) shown = {};
  if (shown.scene) document_.set_frame_count(static_cast<int>(shown.scene->footage->shape.times_s.size()));
  advance(shown);
  scored_ = scoring_.scored();
  tell_of_results();
  window_.begin(settings_);
  draw(shown);
  window_.end();
  textures_.end_turn(PreviewLimits().texture_bytes());
  previewer_.set_texture_bytes(textures_.bytes());
  probe_.tell(document_, shown, places_, {desk_.has_project() ? "project" : "start", turns_a_second_});
  take_edits();
  for (const std::filesystem::path& path : window_.take_dropped()) desk_.take_dropped(path, edits_);
  take_edits();
  for (const Request& request : edits_.take_requests()) take(request);
  if (window_.wants_to_close()) {
    window_.refuse_to_close();
    desk_.take(Quit{});
  }
  const std::uint64_t document = document_.first_number();
  desk_.turn(now_s_);
  if (document_.first_number() != document) {
    playback_.pause();
    own_body_.forget();
    results_.clear();
    scored_.reset();
    scoring_.want({});
  }
  if (const std::optional<RecoveredMask> mask = desk_.take_recovered_mask()) own_body_.recover(*mask);
  previewer_.set_modest(desk_.is_exporting() || own_body_.job().is_running());
  show_title();
  ask_preview();
  done_ = desk_.is_done();
  if (done_) {
    window_.remember_in(settings_);
    (void)write_settings(settings_, settings_file());
  }
}

}  // namespace sigs::editor
