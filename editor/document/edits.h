// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "project/project.h"

namespace sigs::editor {

enum class Selected { nothing, footage, camera, light, intruder, waypoint };

// What the person works on. Numbers count the project's intruders and their waypoints; they count only where the kind
// needs them.
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

// What is asked of the program rather than of the document.
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

// Views put what they want here while they draw. Afterwards the document takes the edits and the program the requests,
// in order.
class Edits {
 public:
  void change(std::string name, std::function<void(Project&)> change, std::string gesture = {}) {
    edits_.emplace_back(ChangeProject{std::move(name), std::move(change), std::move(gesture)});
  }
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

}  // namespace sigs::editor
