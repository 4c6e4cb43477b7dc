// SPDX-License-Identifier: MIT
#include "editor/app/app_shell.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "base/text.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

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

NewProjectFlow::NewProjectFlow(Document& document, Settings& settings, ProjectSession& session, ModelGallery& gallery,
                               std::function<void()> wake)
    : document_(document), settings_(settings), session_(session), dialog_(gallery, wake), job_(std::move(wake)) {}

void NewProjectFlow::open(const fs::path& video) {
  if (job_.is_running()) return;
  job_.forget();
  made_ = nullptr;
  dialog_.open(video, writable_folder(settings_));
}

void NewProjectFlow::draw(const ViewContext& context) {
  choice_ = dialog_.draw(context, job_.state());
}

void NewProjectFlow::look(const ViewContext& context) {
  survey_ = context.shown.surveys.empty() ? nullptr : context.shown.surveys.front();
}

void NewProjectFlow::begin_making(const FirstProjectOptions& options) {
  if (job_.start(options)) dialog_.tell_end();
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
  if (choice.create) session_.replace_then([this, options = *choice.create] { begin_making(options); });
  take_made();
  if (std::exchange(guesses_of_, document_.first_number()) != document_.first_number())
    guesses_.begin(guesses_of(document_.project().file), document_);
  guesses_.follow(document_);
  follow_made();
}

}  // namespace sigs::editor
