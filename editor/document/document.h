// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "editor/document/edits.h"
#include "project/project.h"

namespace sigs::editor {

// A state of the project, kept for undo. Never changes; other threads may hold on to it.
struct Revision {
  std::uint64_t number = 0;  // each state its own; undo comes back to the number it had
  std::shared_ptr<const Project> project;
};

// The project that is edited, its history, and where the person is in it. Changes in apply() alone, once per update of
// the window's loop, after drawing: a drag, an undo and a test take the same way.
class Document {
 public:
  // An empty project; file "" until it is saved.
  Document();
  // Revisions are numbered from first_number on; a program that opens one document after the other keeps them apart so.
  explicit Document(Project project, std::uint64_t first_number = 1);

  [[nodiscard]] const Project& project() const { return *revision_.project; }
  [[nodiscard]] const Revision& revision() const { return revision_; }
  [[nodiscard]] std::uint64_t first_number() const { return first_number_; }
  [[nodiscard]] std::uint64_t last_number() const { return last_number_; }
  [[nodiscard]] const Selection& selection() const { return selection_; }
  [[nodiscard]] int playhead() const { return playhead_; }
  [[nodiscard]] std::optional<int> in() const { return in_; }
  [[nodiscard]] std::optional<int> out() const { return out_; }

  // Whether the project has changed since that revision by anything but this gesture. A drag whose project was changed
  // under it cannot know what its numbers count any more.
  [[nodiscard]] bool has_other_changes(std::uint64_t since_revision, const std::string& gesture) const;

  // Frames that the footage has; 0: not known. The playhead stays within the project's range.
  void set_frame_count(int count);
  [[nodiscard]] int frame_count() const { return frame_count_; }

  // The project's range within the footage, and within it what is marked by in and out (both included). While the
  // footage is not known, what the project says.
  [[nodiscard]] int first_frame() const;
  [[nodiscard]] int last_frame() const;
  [[nodiscard]] int range_first() const;
  [[nodiscard]] int range_last() const;

  [[nodiscard]] bool can_undo() const { return !past_.empty(); }
  [[nodiscard]] bool can_redo() const { return !future_.empty(); }
  [[nodiscard]] std::string undo_name() const;  // "" where there is nothing
  [[nodiscard]] std::string redo_name() const;

  [[nodiscard]] bool has_unsaved_changes() const { return revision_.number != saved_number_; }
  [[nodiscard]] bool has_file() const { return !project().file.empty(); }

  // A change that leaves the project as it was makes no step. One that throws or leaves it with numbers that are not
  // finite is refused as a whole.
  void apply(const Edit& edit);
  void apply(const std::vector<Edit>& edits);

  // Saved under its own file name: what is in the document counts as saved. With another path, the project moves
  // there and its relative paths are rewritten to mean the same files.
  [[nodiscard]] Result<void> save();
  [[nodiscard]] Result<void> save_as(const std::filesystem::path& path);

  // A document recovered after a crash differs from its file.
  void mark_unsaved() { saved_number_ = 0; }

 private:
  struct Step {
    std::string name;
    Revision before;
    Selection selection;
  };

  void change(const ChangeProject& change);
  void end_gesture();
  void cancel_gesture(const std::string& gesture);
  void forget_oldest();
  void step_back();
  void step_forward();
  void keep_selection_valid();
  void keep_playhead_valid();

  Revision revision_;
  std::uint64_t first_number_;
  std::uint64_t last_number_;
  std::uint64_t saved_number_;  // 0: what is in memory was never written
  std::vector<Step> past_;
  std::vector<Step> future_;
  std::string gesture_;                  // of the last step, while it lasts
  std::vector<Step> future_of_gesture_;  // what could be redone before it, for taking it back
  Selection selection_;
  int playhead_ = 0;
  int frame_count_ = 0;
  std::optional<int> in_;
  std::optional<int> out_;
};

}  // namespace sigs::editor
