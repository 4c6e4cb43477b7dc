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

#include "base/result.h"
#include "editor/document/content_id.h"
#include "project/project.h"

namespace sigs::editor {

enum class Selected { nothing, footage, camera, light, intruder, waypoint };

// What is selected. intruder and waypoint are indices into the project, used where the kind needs them.
struct Selection {
  Selected kind = Selected::nothing;
  int intruder = 0;
  int waypoint = 0;

  [[nodiscard]] bool operator==(const Selection&) const = default;
};

// One change of the project. A change with the same gesture as the one before joins its undo step: a drag is one step.
struct ChangeProject {
  std::string name;  // "move waypoint", for the menu: "Undo move waypoint"
  std::function<void(Project&)> change;
  std::string gesture;  // "": a step of its own
};
struct EndGesture {};
// As if the gesture had never begun: the project, the selection, and what could be undone and redone are as before it.
// Nothing happens where another change has come since.
struct CancelGesture {
  std::string gesture;
};
struct Undo {};
struct Redo {};
struct GoToFrame {
  int frame = 0;
};
struct Select {
  Selection selection;
};
// Nothing set: the whole of the project's range.
struct SetInOut {
  std::optional<int> in;
  std::optional<int> out;  // included
};

using Edit = std::variant<ChangeProject, EndGesture, CancelGesture, Undo, Redo, GoToFrame, Select, SetInOut>;

// Requests to the program rather than to the document.
struct OpenProject {
  std::filesystem::path path;
};
struct NewProject {};
struct SaveProject {};  // asks for a name where there is none
struct SaveProjectAs {
  std::filesystem::path path;  // empty: ask
};
struct CloseProject {};  // back to the start page
struct Quit {};
struct AskForFile {  // opens the file browser; the answer comes as the call
  std::string title;
  std::vector<std::string> extensions;  // ".json"; empty: all
  bool for_saving = false;
  bool of_folder = false;  // a folder is wanted, extensions do not count
  std::filesystem::path start;
  std::function<void(const std::filesystem::path&)> chosen;
};
struct Play {
  double speed = 1;  // times the footage's own; negative: backwards; 0: stop
};
struct TogglePlay {};
struct SetLoop {
  bool loop = true;
};
struct ShowExport {};
struct ShowHelp {};
struct ShowSettings {};
struct ShowAbout {};
struct ShowOwnBody {};       // where the own body's mask is found and painted
struct ShowHorizon {};       // its line over the footage, to be laid onto the footage's own
struct ShowMissingFiles {};  // to tell where they are
struct ToggleFullScreen {};
struct LoadResults {           // of a tracker, to be shown beside the truth
  std::filesystem::path path;  // empty: ask
};
struct RemoveResults {
  int id = 0;  // ResultFile::id; the file on disk stays
};
struct ShowResults {
  int id = 0;
  bool shown = true;
};
struct ClearMessages {};  // those that are shown speak of a project that is no longer open
struct ShowMessage {      // a passing message above the timeline
  std::string text;
  bool is_error = false;
};

using Request =
    std::variant<OpenProject, NewProject, SaveProject, SaveProjectAs, CloseProject, Quit, AskForFile, Play, TogglePlay,
                 SetLoop, ShowExport, ShowOwnBody, ShowHorizon, ShowHelp, ShowSettings, ShowAbout, ShowMissingFiles,
                 ToggleFullScreen, LoadResults, RemoveResults, ShowResults, ClearMessages, ShowMessage>;

// Views queue here what they want while they draw. After that the document applies the edits and the program handles
// the requests, in order.
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
  std::vector<std::string> answers;  // the first is the usual one, the last changes nothing
};

// A state of the project, kept for undo. The project never changes; other threads may keep it. Undo comes back to the
// number and the content that the state had.
struct Revision {
  Revision() = default;
  Revision(std::uint64_t revision_number, std::shared_ptr<const Project> state)
      : number(revision_number), project(std::move(state)), content(content_id_of(*project)) {}

  std::uint64_t number = 0;  // each state has its own, from 1 on; 0: no state
  std::shared_ptr<const Project> project;
  ContentId content;  // of the project's settings; states with equal images share it

  // Numbers are never given twice.
  [[nodiscard]] bool operator==(const Revision& other) const { return number == other.number; }
};

// The project that is edited, its history, its selection and the playhead. It changes only in apply(), which is called
// once per update of the window's loop, after drawing. Frames are indices of the footage, from 0.
class Document {
 public:
  // An empty project; file "" until it is saved.
  Document();
  // Revisions are numbered from first_number on, so that documents opened one after the other have no number in common.
  explicit Document(Project project, std::uint64_t first_number = 1);

  [[nodiscard]] const Project& project() const { return *revision_.project; }
  [[nodiscard]] const Revision& revision() const { return revision_; }
  [[nodiscard]] std::uint64_t first_number() const { return first_number_; }
  [[nodiscard]] std::uint64_t last_number() const { return last_number_; }
  [[nodiscard]] const Selection& selection() const { return selection_; }
  [[nodiscard]] int playhead() const { return playhead_; }
  [[nodiscard]] std::optional<int> in() const { return in_; }
  [[nodiscard]] std::optional<int> out() const { return out_; }

  // Whether the project has changed since that revision by anything but this gesture. A drag has to end then: the
  // waypoint that it holds may have another index.
  [[nodiscard]] bool has_other_changes(std::uint64_t since_revision, const std::string& gesture) const;

  // Number of frames of the footage; 0: not known. The playhead is moved into the project's range.
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

  // Applies an edit. A change that leaves the project as it was makes no step of undo. A change that throws, or that
  // leaves a number in the project that is not finite, is refused as a whole.
  void apply(const Edit& edit);
  void apply(const std::vector<Edit>& edits);

  // Writes the project to its own file, or to another path; it belongs there from then on, and its relative paths are
  // rewritten to mean the same files. Errors: cannot_create, write_failed.
  [[nodiscard]] Result<void> save();
  [[nodiscard]] Result<void> save_as(const std::filesystem::path& path);

  // For a project that was recovered after a crash and differs from its file.
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
