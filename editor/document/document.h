// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "editor/document/content_id.h"
#include "editor/document/edits.h"
#include "project/project.h"
#include "project/validate.h"

namespace sigs::editor {

// Something that the person has to decide before the program goes on.
struct Question {
  std::string title;
  std::string text;
  std::vector<std::string> answers;  // the first is the usual one; the last changes nothing, and Escape means it
};

// A state of the project, kept for undo. The project never changes; other threads may keep it. Undo comes back to the
// number and the content that the state had, so what was computed for it is found again.
struct Revision {
  Revision() = default;
  Revision(std::uint64_t revision_number, std::shared_ptr<const Project> state)
      : number(revision_number), project(std::move(state)), content(content_id_of(*project)) {}

  std::uint64_t number = 0;                // each state has its own, from 1 on; 0: no state
  std::shared_ptr<const Project> project;  // null for number 0 alone
  ContentId content;                       // digest of the project's settings; states with equal images share it

  // Numbers are never given twice.
  [[nodiscard]] bool operator==(const Revision& other) const { return number == other.number; }
};

// The number of the state of which a revision shows what one camera sees: that of the first camera's revision, which is
// the project's own where it has one camera.
[[nodiscard]] constexpr std::uint64_t state_number(std::uint64_t revision_number) {
  return revision_number & ((std::uint64_t(1) << 40) - 1);
}
// A project as each of its cameras sees it, by their index; one with a single camera as it is. They keep the project's
// name. Their numbers differ, and have the state's state_number().
[[nodiscard]] Revision revision_of_camera(const Revision& whole, std::size_t camera);

// The project that is edited, its history, its selection and the playhead. It changes in apply(), which is called once
// per update of the window's loop, after drawing, and in the other calls that are not const. Frames are indices of the
// footage, from 0. For the window's thread; other threads work with the revision() that they were given.
//
// A project with several cameras is looked at through one of them, the active one: project() and revision() are what it
// sees, and a change is made on that and goes back to the whole (put_back() of project/project.h). Frames are those of
// the first camera, which waypoints count.
//
// A document belongs to one file, the one that it was opened from or saved to last, which project().file names: no
// edit, undo or redo changes that.
class Document {
 public:
  Document() : Document(Project()) {}  // an empty project; file "" until it is saved
  // Opens a project as it was read; it counts as saved. Revisions are numbered from first_number on, so that documents
  // opened one after the other have no number in common. The playhead is at the project's first frame.
  //   as_read  the stamp of the project's file from before it was read; none: the file is looked at here
  explicit Document(Project project, std::uint64_t first_number = 1, std::optional<FileStamp> as_read = {});

  // As the active camera sees it; the project itself where it has one camera.
  [[nodiscard]] const Project& project() const { return *revision_.project; }
  // What the file has; the same as project() where it has one camera.
  [[nodiscard]] const Project& whole() const { return *state_.project; }
  // Names of the cameras of a project with several; else empty.
  [[nodiscard]] const std::vector<RigCamera>& cameras() const { return whole().cameras; }
  [[nodiscard]] std::size_t active_camera() const { return active_camera_; }
  // The present state, as the active camera sees it; keep a copy, not the reference.
  [[nodiscard]] const Revision& revision() const { return revision_; }
  // The same with all cameras.
  [[nodiscard]] const Revision& state() const { return state_; }
  // Which numbers were given to revisions of this document: by them a result is known to be of another document.
  [[nodiscard]] std::uint64_t first_number() const { return first_number_; }
  [[nodiscard]] std::uint64_t last_number() const { return last_number_; }
  [[nodiscard]] const Selection& selection() const { return selection_; }
  // The frame that is shown; always within first_frame() .. last_frame().
  [[nodiscard]] int playhead() const { return playhead_; }
  // The marks as they were set, even where the project's range does not reach them; range_first() and range_last()
  // count.
  [[nodiscard]] std::optional<int> in() const { return in_; }
  [[nodiscard]] std::optional<int> out() const { return out_; }

  // Whether the project is not as in that revision any more, for another reason than changes of this gesture. A drag
  // has to end then: the waypoint that it holds may have another index.
  [[nodiscard]] bool has_other_changes(std::uint64_t since_revision, const std::string& gesture) const;

  // Number of frames of the footage (of a rig: of the first camera's), once it is open; 0: not known. The playhead is
  // moved into the project's range.
  void set_frame_count(int count);
  [[nodiscard]] int frame_count() const { return frame_count_; }

  // The project's range within the footage, and within it what is marked by in and out (both included). While the
  // footage is not known, what the project says.
  [[nodiscard]] int first_frame() const;
  [[nodiscard]] int last_frame() const;
  [[nodiscard]] int range_first() const;
  [[nodiscard]] int range_last() const;

  // Undo goes back by steps of the project, not of the selection or the playhead; a step brings back the selection from
  // before it. At most 1000 steps are kept, fewer of projects with very many waypoints.
  [[nodiscard]] bool can_undo() const { return !past_.empty(); }
  [[nodiscard]] bool can_redo() const { return !future_.empty(); }
  // Names of the steps, for the menu; "" where there is none.
  [[nodiscard]] std::string undo_name() const { return past_.empty() ? "" : past_.back().name; }
  [[nodiscard]] std::string redo_name() const { return future_.empty() ? "" : future_.back().name; }

  // Whether the present state is another one than that which was read or saved; undo may lead back to it.
  [[nodiscard]] bool has_unsaved_changes() const { return state_.number != saved_number_; }
  [[nodiscard]] bool has_file() const { return !project().file.empty(); }

  // The file that save() writes, as it was when it was last read or saved here; its path is absolute.
  [[nodiscard]] const FileStamp& file_stamp() const { return file_stamp_; }
  // Whether that file has another size or time since, so that saving would lose what another program wrote. A file
  // that is gone counts as unchanged: nobody's work lies there. Asks the file system.
  [[nodiscard]] bool file_has_changed() const;

  // Applies an edit. A change that leaves the project as it was makes no step of undo. A change that throws, or that
  // leaves a number in the project that is not finite, is refused as a whole. Waypoints that are places on the Earth
  // have place and position_m in step afterwards (project/places.h).
  void apply(const Edit& edit);
  void apply(const std::vector<Edit>& edits) {
    for (const Edit& edit : edits) apply(edit);
  }

  // Writes the project to its own file, or to another path; it belongs there from then on, with all that can be undone
  // and redone, and its relative paths are rewritten to mean the same files. A file that is there is replaced at once
  // by the complete one. Errors: cannot_create (without a file name too), write_failed; then nothing has changed.
  [[nodiscard]] Result<void> save() { return save_as(project().file); }
  [[nodiscard]] Result<void> save_as(const std::filesystem::path& path);

  // For a project that was recovered after a crash and differs from its file.
  void mark_unsaved() { saved_number_ = 0; }

 private:
  // What an undo step goes back to. In future_ the same is what redo goes on to. The state names the file that the
  // document belonged to when it arose.
  struct Step {
    std::string name;
    Revision before;
    Selection selection;
  };

  void change(const ChangeProject& change);
  void end_gesture();
  void cancel_gesture(const std::string& gesture);
  void forget_oldest();  // drops steps beyond the limit of the history
  // Undo or redo: the last step of the one becomes a step of the other.
  void take_step(std::vector<Step>& from, std::vector<Step>& to);
  void show(Revision state);  // sets the present state, and what the active camera sees of it
  [[nodiscard]] const FootageSettings& counted_footage() const;
  // After every edit: indices and frames that no longer exist become the nearest that do.
  void keep_selection_valid();
  void keep_playhead_valid();

  Revision state_;     // the project with all of its cameras
  Revision revision_;  // of that, what the active camera sees
  std::size_t active_camera_ = 0;
  std::uint64_t first_number_;
  std::uint64_t last_number_;
  std::uint64_t saved_number_;  // number of the state that lies in the file; 0: what is in memory was never written
  FileStamp file_stamp_;
  std::vector<Step> past_;
  std::vector<Step> future_;
  std::string gesture_;                  // of the last step, while it lasts; "": none
  std::vector<Step> future_of_gesture_;  // what could be redone before it, so that CancelGesture can bring it back
  Selection selection_;
  int playhead_ = 0;
  int frame_count_ = 0;
  std::optional<int> in_;
  std::optional<int> out_;
};

// A setting, or a group of settings ("light", "intruders[0].trajectory"), and what was guessed.
struct Guess {
  Problem text;
  std::string value = {};  // setting_text() (project/json.h) as it was guessed
};

// The settings of a project that were guessed when it was made, and that nobody has changed since: what the user still
// has to look at. Knows no window.
class Guesses {
 public:
  // The project that the document holds was made with these guesses, today or earlier. A guess without a value was made
  // with the value that its setting has.
  void begin(std::vector<Guess> guesses, const Document& document);

  // Once per update: leaves out what has another value than was guessed; an undo brings it back. All are gone once
  // the document is another one.
  void follow(const Document& document);

  // As of the last call.
  [[nodiscard]] const std::vector<Problem>& left() const { return left_; }

 private:
  std::vector<Guess> guesses_;
  std::vector<Problem> left_;
  // Of the document that they belong to, and of its revision that left_ is of.
  std::uint64_t first_number_ = 0;
  std::uint64_t revision_ = 0;
};

}  // namespace sigs::editor
