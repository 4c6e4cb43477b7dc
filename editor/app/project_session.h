// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/app/project_loader.h"
#include "editor/document/document.h"
#include "editor/document/recovery.h"
#include "editor/document/settings.h"

namespace sigs::editor {

// Opens, saves, closes and recovers projects, and asks the questions that belong to it. It knows no window: it says
// which questions and messages to show, and the AppShell shows them. Unsaved work is never dropped without a question.
class ProjectSession {
 public:
  // The own-body mask that is being painted, which belongs to no project yet.
  struct UnsavedMask {
    std::function<std::uint64_t()> unsaved;                     // 0: it may go; else the state that would be lost
    std::function<void(std::function<void()> next)> save_then;  // asks for its name; next: once it is written
    std::function<MaskToKeep()> to_keep;                        // for the case of a crash
  };
  struct Environment {
    std::filesystem::path recovery_folder;
    std::function<void()> wake;          // called from another thread when a file was read
    std::function<bool()> is_exporting;  // an export is lost by quitting
    UnsavedMask mask;
    std::function<bool()> is_asking_for_file;  // a file is being chosen: no other project comes meanwhile
  };
  // Document and settings must outlive it. At first no project is open.
  ProjectSession(Document& document, Settings& settings, Environment environment);

  // Open, new, save, close, quit. False: it was another request, nothing happened. While a question is open it waits
  // until that is answered.
  bool handle(const Request& request);
  // A file came from outside: opened, or put into the project.
  void handle_dropped(const std::filesystem::path& path, Edits& edits);

  void recover(const AbandonedProject& abandoned);
  void discard(const AbandonedProject& abandoned);
  // As of the start and of what was done with them since.
  [[nodiscard]] const std::vector<AbandonedProject>& abandoned() const { return abandoned_; }

  // Once per update, when the document has taken its edits.
  void update(double now_s);

  // The mask of the project that was recovered, for whoever paints it; once, none else.
  [[nodiscard]] std::optional<RecoveredMask> take_recovered_mask() { return std::exchange(recovered_mask_, {}); }

  // What to ask; answer it by the number of its answer. Nothing else goes on meanwhile.
  [[nodiscard]] const std::optional<Question>& question() const { return question_; }
  void answer(int number);

  // What to tell and which files to ask for, since the last call.
  [[nodiscard]] std::vector<Request> take_requests();

  [[nodiscard]] bool has_project() const { return has_project_; }
  [[nodiscard]] std::filesystem::path loading() const { return loader_.path(); }
  [[nodiscard]] bool is_done() const { return done_; }

 private:
  using Step = std::function<void()>;

  void show_message(std::string text, bool is_error = false);
  void ask(Question question, std::vector<Step> steps);
  [[nodiscard]] bool waits(Step step);  // for the question that is open; false: none is
  void run_next_waiting();
  [[nodiscard]] bool is_of_files(const Request& request) const;
  [[nodiscard]] std::function<void(const std::filesystem::path&)> for_this_document(
      std::function<void(const std::filesystem::path&)> chosen) const;
  void ask_which_to_open();
  void leave_then(Step next);  // next: once nothing unsaved is lost by it
  void leave_document_then(Step next);
  [[nodiscard]] std::uint64_t unsaved_mask() const;
  void quit();
  void open(const std::filesystem::path& path);
  void show(Project project);
  void close();
  void save_then(Step next);
  void save_as_then(const std::filesystem::path& path, Step next);
  void write_then(const std::filesystem::path& path, const Step& next);
  void take_loaded();
  void show_recovered(const AbandonedProject& abandoned);
  [[nodiscard]] MaskToKeep mask_to_keep() const;
  void keep_mask_after_saving();

  Document& document_;
  Settings& settings_;
  Environment environment_;
  ProjectLoader loader_;
  Recovery recovery_;
  DiskChange disk_;
  std::vector<AbandonedProject> abandoned_;
  std::optional<RecoveredMask> recovered_mask_;
  std::optional<Question> question_;
  std::vector<Step> steps_;   // one for each answer
  std::deque<Step> waiting_;  // what came while a question was open, oldest first
  std::vector<Request> requests_;
  std::uint64_t discardable_state_ = 0;       // the unsaved state that the person agreed to give up
  std::uint64_t discardable_mask_state_ = 0;  // and of the mask
  bool has_project_ = false;
  bool done_ = false;
};

}  // namespace sigs::editor
