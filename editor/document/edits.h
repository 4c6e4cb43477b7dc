// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/image.h"
#include "project/project.h"

// What views ask for: changes of the document, and what the program is to do.
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

// What of a project with several cameras a change is made on: the project as one of them sees it (project/project.h),
// or the whole.
enum class ChangeOf { active_camera, whole };

// One change of the project.
struct ChangeProject {
  std::string name;  // for the menu: "move waypoint" reads "Undo move waypoint"
  // Called once, on a copy of the project; it may throw, and then nothing changes.
  std::function<void(Project&)> change;
  // A change with the same gesture as the one before joins its undo step, so that a drag is one step. "": a step of its
  // own.
  std::string gesture;
  ChangeOf of = ChangeOf::active_camera;
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
// Another camera of the project is looked through; clamped to those that there are. No step of undo.
struct ActivateCamera {
  std::size_t camera = 0;
};
// Marks a part of the project's range, by frames of the footage, both included; swapped where in > out. Nothing set:
// the whole range.
struct SetInOut {
  std::optional<int> in;
  std::optional<int> out;
};

// What changes the document; see Document::apply().
using Edit =
    std::variant<ChangeProject, EndGesture, CancelGesture, Undo, Redo, GoToFrame, Select, SetInOut, ActivateCamera>;

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
  std::filesystem::path start;          // as FileDialogRequest::start
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
// All cameras of a rig side by side; again: the active one alone.
struct ToggleAllCameras {};
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
                 Play, TogglePlay, SetLoop, ShowExport, ShowOwnBody, ShowHorizon, ToggleAllCameras, ShowHelp,
                 ShowSettings, ShowAbout, ShowMissingFiles, ToggleFullScreen, EstimateCameraMotion, StopCameraMotion,
                 MatchFootage, StopMatchingFootage, ShowLightLike, LightLike, StopLightLike, LoadResults, RemoveResults,
                 ShowResults, ShowAllSettings, ShowModels, ClearMessages, ShowMessage>;

// Views queue here what they want while they draw, so that the project does not change under the views that are drawn
// after them. After that the document applies the edits and the program handles the requests, in the order in which
// they came. For the window's thread.
class Edits {
 public:
  void change(std::string name, std::function<void(Project&)> change, std::string gesture = {}) {
    edits_.emplace_back(ChangeProject{std::move(name), std::move(change), std::move(gesture)});
  }
  // Of a project with several cameras the whole is changed; of others as change().
  void change_whole(std::string name, std::function<void(Project&)> change) {
    edits_.emplace_back(ChangeProject{std::move(name), std::move(change), {}, ChangeOf::whole});
  }
  void activate_camera(std::size_t camera) { edits_.emplace_back(ActivateCamera{camera}); }
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

}  // namespace sigs::editor
