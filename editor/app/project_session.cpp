// SPDX-License-Identifier: MIT
#include "editor/app/project_session.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "base/text.h"
#include "base/threads.h"
#include "editor/document/project_paths.h"
#include "editor/widgets/texts.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxName = 80;  // bytes, in a sentence

std::string shown_name(const Project& project) {
  return shortened(project.file.empty() ? project.name : project.file.filename().string(), kMaxName);
}

bool is_of_files(const Request& request) {
  return std::holds_alternative<OpenProject>(request) || std::holds_alternative<SaveProjectAs>(request) ||
         std::holds_alternative<SaveProject>(request) || std::holds_alternative<NewProject>(request) ||
         std::holds_alternative<CloseProject>(request) || std::holds_alternative<Quit>(request);
}

// Where a project that was never saved belongs: beside its footage; without any beside the project saved or opened
// last.
fs::path first_folder(const Project& project, const Settings& settings) {
  std::error_code code;
  if (!project.footage.video.empty()) {
    const fs::path beside = fs::absolute(project.footage.video, code).parent_path();
    if (fs::is_directory(beside, code)) return beside;
  }
  if (!settings.recent.empty() && fs::is_directory(settings.recent.front().parent_path(), code))
    return settings.recent.front().parent_path();
  return settings.last_folder;
}

}  // namespace

ProjectSession::ProjectSession(Document& document, Settings& settings, Environment environment)
    : document_(document),
      settings_(settings),
      environment_(std::move(environment)),
      recovery_(environment_.recovery_folder),
      abandoned_(abandoned_projects(environment_.recovery_folder)) {}

// What was asked for while a question is open begins anew after its answer: by then nothing may be left to be asked.
bool ProjectSession::waits(Step step) {
  if (!question_) return false;
  waiting_.push_back(std::move(step));
  return true;
}

void ProjectSession::ask(Question question, std::vector<Step> steps) {
  if (waits([this, question, steps] { ask(question, steps); })) return;
  question_ = std::move(question);
  steps_ = std::move(steps);
}

void ProjectSession::answer(int number) {
  question_.reset();
  const std::vector<Step> steps = std::exchange(steps_, {});
  if (number >= 0 && number < static_cast<int>(steps.size()) && steps[static_cast<std::size_t>(number)])
    steps[static_cast<std::size_t>(number)]();
  // What waited, until one of it asks again.
  while (!question_ && !done_ && !waiting_.empty()) {
    const Step step = std::move(waiting_.front());
    waiting_.pop_front();
    step();
  }
}

bool ProjectSession::handle(const Request& request) {
  if (!is_of_files(request)) return false;
  if (waits([this, request] { handle(request); })) return true;
  const auto* to_open = std::get_if<OpenProject>(&request);
  const auto* to_save = std::get_if<SaveProjectAs>(&request);
  if (to_open != nullptr) {
    if (to_open->path.empty())
      requests_.push_back(AskForFile{.title = "Open a project",
                                     .extensions = {".json"},
                                     .chosen = [this](const fs::path& path) { handle(OpenProject{path}); }});
    else
      leave_then([this, path = to_open->path] { open(path); });
  } else if (to_save != nullptr) {
    if (has_project_) save_as_then(to_save->path, {});
  } else if (std::holds_alternative<SaveProject>(request)) {
    if (has_project_) save_then({});
  } else if (std::holds_alternative<NewProject>(request)) {
    leave_then([this] { show(Project()); });
  } else if (std::holds_alternative<CloseProject>(request)) {
    leave_then([this] { close(); });
  } else {
    quit();
  }
  return true;
}

MaskToKeep ProjectSession::mask_to_keep() const {
  return has_project_ && environment_.mask.to_keep ? environment_.mask.to_keep() : MaskToKeep();
}

// The project is safe, the mask may not be: what lies on disk for it must not be older than the project.
void ProjectSession::keep_mask_after_saving() {
  const MaskToKeep mask = mask_to_keep();
  if (mask.state == 0 || mask.is_changing)
    recovery_.forget();
  else
    (void)recovery_.write(document_, mask);  // what goes wrong keep() tells
}

std::uint64_t ProjectSession::unsaved_mask() const {
  return has_project_ && environment_.mask.unsaved ? environment_.mask.unsaved() : 0;
}

void ProjectSession::leave_then(Step next) {
  const std::uint64_t mask = unsaved_mask();
  if (mask == 0) return leave_document_then(std::move(next));
  const auto give_up = [this, mask, next] {
    discardable_mask_state_ = mask;
    leave_document_then(next);
  };
  ask({.title = "Unsaved mask",
       .text = "The own-body mask was detected or painted and not saved. Save it and use it in the project?",
       .answers = {"Save and use...", "Don't save", "Cancel"}},
      {[this, next] { environment_.mask.save_then([this, next] { leave_then(next); }); }, give_up, {}});
}

void ProjectSession::leave_document_then(Step next) {
  if (!has_project_ || !document_.has_unsaved_changes()) return next();
  const auto give_up = [this, next] {
    discardable_state_ = document_.state().number;
    next();
  };
  ask({.title = "Unsaved changes",
       .text = fmt::format("Save the changes of {}?", shown_name(document_.project())),
       .answers = {"Save", "Don't save", "Cancel"}},
      {[this, next] { save_then(next); }, give_up, {}});
}

void ProjectSession::quit() {
  const auto end = [this] {
    recovery_.forget();
    done_ = true;
  };
  const auto leave = [this, end] { leave_then(end); };
  if (!environment_.is_exporting || !environment_.is_exporting()) return leave();
  ask({.title = "An export is running",
       .text = "Quitting stops it; nothing of it is kept.",
       .answers = {"Go on exporting", "Stop it and quit", "Cancel"}},
      {{}, leave, {}});
}

void ProjectSession::replace_then(std::function<void()> next) {
  if (waits([this, next] { replace_then(next); })) return;
  leave_then(std::move(next));
}

void ProjectSession::open(const fs::path& path) {
  // The project keeps an absolute path: it means the same file in messages, lists of recent ones and after a crash.
  loading_ = fs::absolute(path).lexically_normal();
  const auto promise = std::make_shared<std::promise<LoadedProject>>();
  loaded_ = promise->get_future();
  run_in_background([promise, file = loading_, wake = environment_.wake] {
    FileStamp as_read = stamp_of(file);
    promise->set_value({std::move(as_read), guarded([&] { return read_project(file); }, file.string())});
    wake();
  });
}

void ProjectSession::show(Project project, std::optional<FileStamp> as_read) {
  recovery_.forget();
  requests_.emplace_back(ClearMessages{});
  document_ = Document(std::move(project), document_.last_number() + 1, std::move(as_read));
  has_project_ = true;
}

void ProjectSession::close() {
  show(Project());
  has_project_ = false;
  abandoned_ = abandoned_projects(environment_.recovery_folder);
}

void ProjectSession::take_loaded() {
  const bool is_asking_for_file = environment_.is_asking_for_file && environment_.is_asking_for_file();
  if (question_ || is_asking_for_file) return;
  if (!loaded_.valid() || loaded_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  LoadedProject loaded = loaded_.get();
  const fs::path path = std::exchange(loading_, {});
  if (!loaded.read) {
    std::erase(settings_.recent, path);
    return show_message(loaded.read.error().text(), true);
  }
  // Something was done while the file was read.
  const bool was_agreed = discardable_state_ == document_.state().number;
  const bool mask_was_agreed = unsaved_mask() == 0 || unsaved_mask() == discardable_mask_state_;
  if (has_project_ && ((document_.has_unsaved_changes() && !was_agreed) || !mask_was_agreed))
    return leave_then([this, path] { open(path); });
  show(std::move(loaded.read->project), std::move(loaded.as_read));
  remember_project(settings_, path);
  for (const Warning& warning : loaded.read->warnings) show_message(warning.text());
  if (const std::size_t missing = missing_files(document_.whole()).size(); missing > 0)
    show_message(fmt::format("{} of this project {} missing; File > Find missing files shows which",
                             count_text(static_cast<std::int64_t>(missing), "file"), missing == 1 ? "is" : "are"),
                 true);
}

void ProjectSession::save_then(Step next) {
  const fs::path file = document_.project().file;
  if (file.empty()) return save_as_then({}, std::move(next));
  if (!document_.file_has_changed()) return write_then(file, next);
  ask({.title = "Changed on disk",
       .text = file.filename().string() + " was changed by another program since it was read here. Replace it?",
       .answers = {"Save as...", "Replace it", "Cancel"}},
      {[this, next] { save_as_then({}, next); }, [this, file, next] { write_then(file, next); }, {}});
}

void ProjectSession::save_as_then(const fs::path& path, Step next) {
  if (!path.empty()) return write_then(path, next);
  const Project& project = document_.project();
  const fs::path start =
      project.file.empty() ? first_folder(project, settings_) / (project.name + ".json") : project.file;
  requests_.push_back(
      AskForFile{.title = "Save the project as",
                 .extensions = {".json"},
                 .for_saving = true,
                 .start = start,
                 .chosen = for_this_document([this, next](const fs::path& chosen) { write_then(chosen, next); })});
}

// A name that was asked for one project is none for another that has come meanwhile.
std::function<void(const fs::path&)> ProjectSession::for_this_document(
    std::function<void(const fs::path&)> chosen) const {
  return [this, chosen = std::move(chosen), document = document_.first_number()](const fs::path& path) {
    if (document_.first_number() == document) chosen(path);
  };
}

void ProjectSession::write_then(const fs::path& path, const Step& next) {
  const fs::path place = fs::absolute(path).lexically_normal();
  // A project is called after its file until it is given a name.
  if (!document_.has_file() && document_.project().name == Project().name)
    document_.apply(ChangeProject{"name", [&](Project& p) { p.name = place.stem().string(); }, {}});
  if (const Result<void> saved = document_.save_as(place); !saved) {
    show_message(saved.error().text() + "; nothing was saved", true);
    return;
  }
  keep_mask_after_saving();
  remember_project(settings_, place);
  show_message("Saved " + place.filename().string());
  if (next) next();
}

void ProjectSession::recover(const AbandonedProject& abandoned) {
  if (waits([this, abandoned] { recover(abandoned); })) return;
  leave_then([this, abandoned] { show_recovered(abandoned); });
}

// One that cannot be opened stays in the list, with the reason: it can be discarded there.
void ProjectSession::show_recovered(const AbandonedProject& abandoned) {
  recovery_.forget();
  Result<RecoveredProject> taken = recovery_.take_over(abandoned);
  if (!taken) {
    for (AbandonedProject& other : abandoned_)
      if (other.recovery_file == abandoned.recovery_file) other.problem = taken.error().text();
    show_message(taken.error().text(), true);
    return;
  }
  std::erase_if(abandoned_, [&](const auto& other) { return other.recovery_file == abandoned.recovery_file; });
  document_ = Document(std::move(taken->read.project), document_.last_number() + 1, std::move(taken->as_read));
  document_.mark_unsaved();
  has_project_ = true;
  recovered_mask_ = std::move(taken->mask);
  if (!taken->mask_problem.empty()) show_message("The own-body mask is lost: " + taken->mask_problem, true);
  const std::string name = shortened(abandoned.name, kMaxName);
  show_message(recovered_mask_
                   ? fmt::format("Recovered {} and the own-body mask that was painted; save both to keep them", name)
                   : fmt::format("Recovered {}; save it to keep it", name));
}

void ProjectSession::discard(const AbandonedProject& abandoned) {
  if (waits([this, abandoned] { discard(abandoned); })) return;
  const auto gone = [this, abandoned] {
    editor::discard(abandoned);
    std::erase_if(abandoned_, [&](const auto& other) { return other.recovery_file == abandoned.recovery_file; });
  };
  const bool is_readable = abandoned.problem.empty();
  ask({.title = "Discard unsaved changes",
       .text = (is_readable ? "The unsaved changes of " + shortened(abandoned.name, kMaxName)
                            : "What lies in " + abandoned.recovery_file.string()) +
               " will be gone for good.",
       .answers = {"Discard", "Keep"}},
      {gone, {}});
}

void ProjectSession::handle_dropped(const fs::path& path, Edits& edits) {
  const DroppedFile dropped = classified_drop(path);
  if (dropped.kind == DroppedKind::nothing) return show_message(dropped.problem, true);
  if (dropped.kind == DroppedKind::project) {
    handle(OpenProject{path});
    return;
  }
  if (dropped.kind == DroppedKind::results) {
    if (has_project_)
      edits.ask(LoadResults{path});
    else
      show_message(fmt::format("Open the project that {} belongs to, then drop it again", path.filename().string()),
                   true);
    return;
  }
  if (!has_project_) show(Project());
  if (std::optional<ChangeProject> change = change_by(dropped, document_.selection())) {
    show_message(path.filename().string() + ": " + change->name);
    edits.change(std::move(change->name), std::move(change->change));
  }
}

void ProjectSession::update(double now_s) {
  take_loaded();
  if (!has_project_) return;
  if (const std::optional<Error> error = recovery_.keep(document_, now_s, settings_.autosave_s, mask_to_keep()))
    show_message("Unsaved changes cannot be kept for recovery: " + error->text(), true);
}

}  // namespace sigs::editor
