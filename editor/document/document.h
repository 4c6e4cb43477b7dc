// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "editor/document/content_id.h"
#include "project/project.h"
#include "project/validate.h"

namespace sigs::editor {

// Kinds of things that can be selected in the views.
enum class Selected { nothing, footage, camera, light, intruder, waypoint };

// What is selected. The indices count in the project; `intruder` means something for the kinds intruder and waypoint,
// `waypoint` for the latter alone. Document keeps them valid.
struct Selection {
  Selected kind = Selected::nothing;
  int intruder = 0;
  int waypoint = 0;

  [[nodiscard]] bool operator==(const Selection&) const = default;
};

// One change of the project.
struct ChangeProject {
  std::string name;  // for the menu: "move waypoint" reads "Undo move waypoint"
  // Called once, on a copy of the project; it may throw, and then nothing changes.
  std::function<void(Project&)> change;
  // A change with the same gesture as the one before joins its undo step, so that a drag is one step. "": a step of its
  // own.
  std::string gesture;
};
// The drag is over: what follows is another undo step, even with the same gesture.
struct EndGesture {};
// As if the gesture had never begun: the project, the selection, and what could be undone and redone are as before it.
// Nothing happens where another change has come since.
struct CancelGesture {
  std::string gesture;
};
struct Undo {};
struct Redo {};
// Moves the playhead; clamped to the project's range.
struct GoToFrame {
  int frame = 0;
};
struct Select {
  Selection selection;
};
// Marks a part of the project's range, by frames of the footage, both included; swapped where in > out. Nothing set:
// the whole range.
struct SetInOut {
  std::optional<int> in;
  std::optional<int> out;
};

// What changes the document; see Document::apply().
using Edit = std::variant<ChangeProject, EndGesture, CancelGesture, Undo, Redo, GoToFrame, Select, SetInOut>;

// Requests to the program rather than to the document. An empty path asks for one.
struct OpenProject {
  std::filesystem::path path;
};
// An empty project.
struct NewProject {};
// The dialog that makes a project of a video.
struct ShowNewProject {
  std::filesystem::path video;  // to begin with; "": none
};
// Asks for a name where there is none.
struct SaveProject {};
struct SaveProjectAs {
  std::filesystem::path path;  // empty: ask
};
// Back to the start page.
struct CloseProject {};
struct Quit {};
// Opens the file browser. The answer comes as the call of `chosen`, in a later update; without an answer nothing is
// called.
struct AskForFile {
  std::string title;
  std::vector<std::string> extensions;  // with their dots: ".json"; empty: all files
  bool for_saving = false;              // the file need not be there; one that is there is asked about
  bool of_folder = false;               // a folder is wanted; extensions do not count
  // As FileDialogRequest::start.
  std::filesystem::path start;
  std::function<void(const std::filesystem::path&)> chosen;
};
// Plays from the playhead on.
struct Play {
  double speed = 1;  // times the footage's own speed; negative: backwards; 0: stop
};
struct TogglePlay {};
struct SetLoop {
  bool loop = true;
};
struct ShowExport {};
struct ShowHelp {};
struct ShowSettings {};
struct ShowAbout {};
// Where the own body's mask is found and painted.
struct ShowOwnBody {};
// The simulated horizon over the footage, to be moved onto the footage's own.
struct ShowHorizon {};
// Begins to estimate the camera's motion from the footage, in the background; stops that.
struct EstimateCameraMotion {};
struct StopCameraMotion {};
// Begins to find how the footage looks, in the background, to make the intruders look like it; stops that.
struct MatchFootage {};
struct StopMatchingFootage {};
// Over the footage a box is drawn around something that the sun lights, and LightLike is asked for.
struct ShowLightLike {};
// Begins to find the light on what is in a box of a frame of the footage (continuous pixels), in the background; stops
// that.
struct LightLike {
  int frame = 0;
  Box box;
};
struct StopLightLike {};
// Whether the inspector shows every setting, or those that most projects need.
struct ShowAllSettings {
  bool all = true;
};
// A dialog with the models that an intruder can have.
struct ShowModels {
  int intruder = 0;
};
// A dialog that asks where the project's missing files are.
struct ShowMissingFiles {};
struct ToggleFullScreen {};
// Results of a tracker, to be shown beside the truth. An empty path asks for one.
struct LoadResults {
  std::filesystem::path path;
};
// The file with this ResultFile::id is no longer shown; on disk it stays.
struct RemoveResults {
  int id = 0;
};
// Switches whether the boxes and the curve of ResultFile::id are drawn.
struct ShowResults {
  int id = 0;
  bool shown = true;
};
// Those that are shown speak of a project that is no longer open.
struct ClearMessages {};
// A passing message above the timeline.
struct ShowMessage {
  std::string text;
  bool is_error = false;
};

// What the program does, and the document does not know of: App and what it owns handle them.
using Request =
    std::variant<OpenProject, NewProject, ShowNewProject, SaveProject, SaveProjectAs, CloseProject, Quit, AskForFile,
                 Play, TogglePlay, SetLoop, ShowExport, ShowOwnBody, ShowHorizon, ShowHelp, ShowSettings, ShowAbout,
                 ShowMissingFiles, ToggleFullScreen, EstimateCameraMotion, StopCameraMotion, MatchFootage,
                 StopMatchingFootage, ShowLightLike, LightLike, StopLightLike, LoadResults, RemoveResults, ShowResults,
                 ShowAllSettings, ShowModels, ClearMessages, ShowMessage>;

// Views queue here what they want while they draw, so that the project does not change under the views that are drawn
// after them. After that the document applies the edits and the program handles the requests, in the order in which
// they came. For the window's thread.
class Edits {
 public:
  void change(std::string name, std::function<void(Project&)> change, std::string gesture = {}) {
    edits_.emplace_back(ChangeProject{std::move(name), std::move(change), std::move(gesture)});
  }
  // Moves a waypoint, as part of the gesture of that name, which ends with end_gesture(). position_m is in the world.
  void move_waypoint(int intruder, int waypoint, const glm::dvec3& position_m, std::string gesture);
  void end_gesture() { edits_.emplace_back(EndGesture{}); }
  void cancel_gesture(std::string gesture) { edits_.emplace_back(CancelGesture{std::move(gesture)}); }
  void undo() { edits_.emplace_back(Undo{}); }
  void redo() { edits_.emplace_back(Redo{}); }
  void go_to_frame(int frame) { edits_.emplace_back(GoToFrame{frame}); }
  void select(Selection selection) { edits_.emplace_back(Select{selection}); }
  void set_in_out(std::optional<int> in, std::optional<int> out) { edits_.emplace_back(SetInOut{in, out}); }
  void ask(Request request) { requests_.emplace_back(std::move(request)); }

  // Each removes and returns what was queued since the last call.
  [[nodiscard]] std::vector<Edit> take_edits() { return std::exchange(edits_, {}); }
  [[nodiscard]] std::vector<Request> take_requests() { return std::exchange(requests_, {}); }

 private:
  std::vector<Edit> edits_;
  std::vector<Request> requests_;
};

// Something that the person has to decide before the program goes on.
struct Question {
  std::string title;
  std::string text;
  // The first is the usual one; the last changes nothing, and Escape means it.
  std::vector<std::string> answers;
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

// The project that is edited, its history, its selection and the playhead. It changes in apply(), which is called once
// per update of the window's loop, after drawing, and in the other calls that are not const. Frames are indices of the
// footage, from 0. For the window's thread; other threads work with the revision() that they were given.
//
// A document belongs to one file, the one that it was opened from or saved to last, which project().file names: no
// edit, undo or redo changes that.
class Document {
 public:
  // An empty project; file "" until it is saved.
  Document();
  // Opens a project as it was read; it counts as saved. Revisions are numbered from first_number on, so that documents
  // opened one after the other have no number in common. The playhead is at the project's first frame.
  //   as_read  the stamp of the project's file from before it was read; none: the file is looked at here
  explicit Document(Project project, std::uint64_t first_number = 1, std::optional<FileStamp> as_read = {});

  [[nodiscard]] const Project& project() const { return *revision_.project; }
  // The present state; keep a copy, not the reference.
  [[nodiscard]] const Revision& revision() const { return revision_; }
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

  // Number of frames of the footage, once it is open; 0: not known. The playhead is moved into the project's range.
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
  [[nodiscard]] std::string undo_name() const;
  [[nodiscard]] std::string redo_name() const;

  // Whether the present state is another one than that which was read or saved; undo may lead back to it.
  [[nodiscard]] bool has_unsaved_changes() const { return revision_.number != saved_number_; }
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
  void apply(const std::vector<Edit>& edits);

  // Writes the project to its own file, or to another path; it belongs there from then on, with all that can be undone
  // and redone, and its relative paths are rewritten to mean the same files. A file that is there is replaced at once
  // by the complete one. Errors: cannot_create (without a file name too), write_failed; then nothing has changed.
  [[nodiscard]] Result<void> save();
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

  // One for each kind of edit.
  void change(const ChangeProject& change);
  void end_gesture();
  void cancel_gesture(const std::string& gesture);
  // Drops steps beyond the limit of the history.
  void forget_oldest();
  void step_back();
  void step_forward();
  // Makes the state of a step the present one, as a state of the document's file, and returns the step that leads back.
  Step exchanged(Step step);
  // After every edit: indices and frames that no longer exist become the nearest that do.
  void keep_selection_valid();
  void keep_playhead_valid();

  Revision revision_;
  std::uint64_t first_number_;
  std::uint64_t last_number_;
  // Number of the state that lies in the file; 0: what is in memory was never written.
  std::uint64_t saved_number_;
  FileStamp file_stamp_;
  std::vector<Step> past_;
  std::vector<Step> future_;
  std::string gesture_;  // of the last step, while it lasts; "": none
  // What could be redone before it, so that CancelGesture can bring it back.
  std::vector<Step> future_of_gesture_;
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
