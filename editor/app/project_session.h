// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "editor/document/document.h"
#include "editor/document/recovery.h"
#include "editor/document/settings.h"
#include "project/json.h"

namespace sigs::editor {

// Opens, saves, closes and recovers projects, and asks the questions that belong to it. It knows no window: it says
// which questions and messages to show, and the AppShell shows them. Unsaved work is never dropped without a question.
class ProjectSession {
 public:
  // What has to be asked of the own-body mask that is being painted, which belongs to no project yet. Empty functions:
  // there is none.
  struct UnsavedMask {
    std::function<std::uint64_t()> unsaved;  // 0: it may go; else the number of the state that would be lost
    // Asks for its name and saves it. next: called once it is written.
    std::function<void(std::function<void()> next)> save_then;
    std::function<MaskToKeep()> to_keep;  // what recovery keeps of it for the case of a crash
  };
  // What the session needs from the program around it.
  struct Environment {
    std::filesystem::path recovery_folder;
    std::function<void()> wake;          // called from another thread when a file was read
    std::function<bool()> is_exporting;  // whether an export would be lost by quitting; empty: none
    UnsavedMask mask;
    std::function<bool()> is_asking_for_file;  // no other project comes meanwhile
  };
  // Document and settings must outlive it. At first no project is open. Looks for abandoned projects on disk.
  ProjectSession(Document& document, Settings& settings, Environment environment);

  // Open, new, save, close, quit. False: it was another request, and nothing happened. While a question is open the
  // request waits until that is answered. Files are read on another thread, so a project that is opened is there in a
  // later update.
  bool handle(const Request& request);
  // A file came from outside, of the kind that classified_drop() finds: a project is opened; results of a tracker are
  // asked to be loaded; all else is put into the project by an edit, into an empty project where none is open.
  void handle_dropped(const std::filesystem::path& path, Edits& edits);

  // Asks for unsaved work, as before another project is opened. next: called at once, or after the answer; not at all
  // where the person keeps the present project.
  void replace_then(std::function<void()> next);
  // Opens a project in place of the present one, whose unsaved work was agreed to be given up in replace_then(); what
  // came after that is asked for.
  void open_agreed(const std::filesystem::path& path) { open(path); }

  // Opens an abandoned project in place of the present one, once that may go.
  void recover(const AbandonedProject& abandoned);
  void discard(const AbandonedProject& abandoned);  // asks whether its files may be removed for good
  // As of the start, or of the last project that was closed, and of what was done with them since.
  [[nodiscard]] const std::vector<AbandonedProject>& abandoned() const { return abandoned_; }

  // Once per update, when the document has taken its edits: shows a project that was read, and keeps unsaved work for
  // recovery.
  //   now_s  seconds of a steady clock
  void update(double now_s);

  // The mask of the project that was recovered, for whoever paints it; given once, none afterwards.
  [[nodiscard]] std::optional<RecoveredMask> take_recovered_mask() { return std::exchange(recovered_mask_, {}); }

  // What to ask; answer() it by the index of its answer. Nothing else goes on meanwhile.
  [[nodiscard]] const std::optional<Question>& question() const { return question_; }
  void answer(int number);

  // What to tell and which files to ask for, since the last call: ShowMessage, ClearMessages and AskForFile.
  [[nodiscard]] std::vector<Request> take_requests() { return std::exchange(requests_, {}); }

  [[nodiscard]] bool has_project() const { return has_project_; }
  // The project file that is being read; "": none.
  [[nodiscard]] const std::filesystem::path& loading() const { return loading_; }
  // The person has quit, and nothing unsaved was lost by it.
  [[nodiscard]] bool is_done() const { return done_; }

 private:
  // A project file that was asked for: the project, or why it could not be read.
  struct LoadedProject {
    FileStamp as_read;  // from before it was read: what is written meanwhile counts as a change
    Result<ReadProject> read;
  };
  // What is done after an answer, or after something was saved. May be empty.
  using Step = std::function<void()>;

  void show_message(std::string text, bool is_error = false) {
    requests_.push_back(ShowMessage{std::move(text), is_error});
  }
  // Asks, with a step for each answer; while another question is open, after that.
  void ask(Question question, std::vector<Step> steps);
  // Whether the step has to wait for the question that is open, and is queued for that; false: none is open.
  [[nodiscard]] bool waits(Step step);
  // The same function, but without effect once another document is open.
  [[nodiscard]] std::function<void(const std::filesystem::path&)> for_this_document(
      std::function<void(const std::filesystem::path&)> chosen) const;
  // Asks for the mask and the document's changes in turn, where they are not saved. next: once nothing unsaved is lost
  // by it.
  void leave_then(Step next);
  void leave_document_then(Step next);
  [[nodiscard]] std::uint64_t unsaved_mask() const;  // as UnsavedMask::unsaved; 0 without a project
  void quit();
  // Begins to read a file on a thread of its own, so that the window does not wait for a slow disk. The last file asked
  // for counts. The thread may outlive the session where a disk does not answer, so `wake` has to stay callable until
  // the program ends.
  void open(const std::filesystem::path& path);
  // Makes a project the document, without a question. as_read: see Document.
  void show(Project project, std::optional<FileStamp> as_read = {});
  void close();
  // Under its name, else under one that is asked for. `next` is called only if it was written.
  void save_then(Step next);
  void save_as_then(const std::filesystem::path& path, Step next);
  void write_then(const std::filesystem::path& path, const Step& next);
  // Shows a project that was read, unless something unsaved has come meanwhile: then it is asked for.
  void take_loaded();
  void show_recovered(const AbandonedProject& abandoned);
  [[nodiscard]] MaskToKeep mask_to_keep() const;
  void keep_mask_after_saving();  // the project is on disk; an unsaved mask stays kept for recovery

  Document& document_;
  Settings& settings_;
  Environment environment_;
  std::filesystem::path loading_;  // absolute
  std::future<LoadedProject> loaded_;
  Recovery recovery_;
  std::vector<AbandonedProject> abandoned_;
  std::optional<RecoveredMask> recovered_mask_;
  std::optional<Question> question_;
  std::vector<Step> steps_;   // one for each answer of question_
  std::deque<Step> waiting_;  // what came while a question was open, oldest first
  std::vector<Request> requests_;
  // The unsaved states of the document and of the mask that the person agreed to give up; 0: none.
  std::uint64_t discardable_state_ = 0;
  std::uint64_t discardable_mask_state_ = 0;
  bool has_project_ = false;
  bool done_ = false;
};

}  // namespace sigs::editor
