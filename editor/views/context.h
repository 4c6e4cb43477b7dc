// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/geometry/lens_projection.h"
#include "editor/preview/jobs.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/scoring.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/textures.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// What the views that are drawn in this update need from the preview. Empty at the start of each update; each view sets
// what it needs while it draws.
struct ViewNeeds {
  bool footage = false;                                // the decoded frame without intruders
  bool stages = false;                                 // the images of all stages of the frame
  std::optional<MethodChoice> compare_with;            // the frame by this method too
  std::optional<PreviewRequest::Turntable> turntable;  // an image of one intruder's model
  bool encounters = false;                             // Survey::encounter
  bool all_cameras = false;                            // the images of all cameras of a rig
  // The view that is worked in takes undo and redo itself: the program's own keys for them do nothing in this update.
  bool own_undo = false;
  bool own_escape = false;  // a view has taken Escape
};

// The input and output of a view in one update. Input: the document, the newest preview, the settings. Output: changes
// and requests of the user in `edits`, what the preview is to compute in `needs`, named places for tests in `ui_probe`.
// A view changes nothing else but its own state (zoom, which overlay is on). It is valid while the update draws:
// functions that are called later must not keep it.
struct ViewContext {
  const Document& document;
  // May be of an older revision than the document, and empty at first. Of a rig it is what the active camera shows. Its
  // surveys, and what is in memory, are by the frames that the document counts; its images by those of the footage.
  const PreviewOutput& shown;
  const Settings& settings;
  Textures& textures;
  // Outlives the update, so what an AskForFile calls later may keep a reference to it.
  Edits& edits;
  ViewNeeds& needs;
  UiProbe& ui_probe;
  bool playing = false;
  double speed = 0;                // of playing, times the footage's own; negative: backwards; 0 while it pauses
  const Scored* scored = nullptr;  // Null: no results of trackers are loaded
  // Of the camera's motion that is estimated in the background. Null: this window has no such job.
  const EgoMotionState* ego_motion = nullptr;
  const AppearanceState* appearance = nullptr;  // of how the footage looks, likewise
  const LightState* light = nullptr;            // of the light on something in the footage, likewise
  // The horizon in the shown scene's footage. Null: not known, or not yet.
  std::shared_ptr<const SeenHorizons> horizons = {};
  // What was guessed of this project when it was made, by setting. Null: nothing.
  const std::vector<Problem>* guesses = nullptr;
  // The same as `shown` for each camera of a rig, by its index. Null: the project has one camera.
  const std::vector<PreviewOutput>* rig = nullptr;

  [[nodiscard]] const Project& project() const { return document.project(); }
};

// The same with what another camera of the rig shows. The document is still seen through the active one.
[[nodiscard]] inline ViewContext seen_from(const ViewContext& context, std::size_t camera) {
  return {.document = context.document,
          .shown = (*context.rig)[camera],
          .settings = context.settings,
          .textures = context.textures,
          .edits = context.edits,
          .needs = context.needs,
          .ui_probe = context.ui_probe,
          .playing = context.playing,
          .speed = context.speed,
          .rig = context.rig};
}

// A drag of the mouse that changes the project. All its changes carry the same gesture name and so make one undo step.
// Escape takes them back; a change that anything else makes to the project meanwhile ends the drag, because its numbers
// may no longer count the same intruders and waypoints.
struct DragGesture {
  // Of the gesture, for Edits::change. Two drags that follow each other need different names, or an end() between them.
  std::string name;
  // Number of the document's revision when the mouse was pressed.
  std::uint64_t revision_before = 0;
  glm::dvec2 pressed{0, 0};  // where it was pressed, on the screen
  // A change has been made or is about to be. The caller sets it, once has_left_press().
  bool is_moving = false;

  // A press moves nothing until the mouse has gone 3 px (where text is 15 px high).
  [[nodiscard]] bool has_left_press(const glm::dvec2& mouse) const {
    return glm::distance(mouse, pressed) >= static_cast<double>(scaled(3));
  }

  // Whether the project has been changed by anything but this drag. The caller drops the drag then, without an end().
  [[nodiscard]] bool is_lost(const ViewContext& context) const {
    return context.document.has_other_changes(revision_before, is_moving ? name : "");
  }

  // Whether Escape was pressed in this update; the changes made so far are taken back then.
  [[nodiscard]] bool cancelled_by_key(const ViewContext& context) const {
    if (!sigs::editor::pressed(Key::escape)) return false;
    cancel(context);
    return true;
  }

  // Takes back all changes of this drag.
  void cancel(const ViewContext& context) const {
    if (is_moving) context.edits.cancel_gesture(name);
  }

  // When the mouse is let go: the undo step is complete.
  void end(const ViewContext& context) const {
    if (is_moving) context.edits.end_gesture();
  }
};

// The scene of what is shown; null: there is none yet.
[[nodiscard]] inline const Scene* shown_scene(const ViewContext& context) {
  return context.shown.scene ? &context.shown.scene->draft.scene : nullptr;
}

// A drag that begins at a place of the screen in this update.
[[nodiscard]] inline DragGesture drag_gesture_at(const ViewContext& context, const glm::dvec2& mouse,
                                                 std::string name = {}) {
  return {.name = std::move(name), .revision_before = context.document.revision().number, .pressed = mouse};
}

// Where the camera is, for all views. What the project alone decides (place at the start, mounting, speed) is the
// document's, so that it does not lag behind a drag; what files decide (path and attitude of a log, an attitude file)
// is that of the newest scene that is open.

// The camera by the settings alone: straight on along world X, with what carries it level.
[[nodiscard]] CameraPose camera_pose_at(const Project& project, double time_s);

// The camera at a time of the footage; of a rig the active one, at a time of the rig's clock.
[[nodiscard]] CameraPose camera_pose_at(const ViewContext& context, double time_s);

// Time of a frame that the document counts, in seconds, by the footage where it is known, else by 25 frames a second.
[[nodiscard]] double time_of(const ViewContext& context, double frame);

// The frame of the active camera's footage at the playhead; the playhead itself where the project has one camera.
[[nodiscard]] int footage_frame(const ViewContext& context);

// How far the document's camera.position_m has moved the path of the scene's log since that scene was opened; 0 where
// no log moves the camera. World, metres.
[[nodiscard]] glm::dvec3 path_shift_m(const ViewContext& context);

// Whether a file turns the camera: an attitude file, or a log that was read.
[[nodiscard]] bool is_turned_by_file(const ViewContext& context);

// Along which axes of the world camera.position_m moves the camera: all, unless a log gives its place on the Earth.
[[nodiscard]] glm::bvec3 movable_axes(const ViewContext& context);

// Why the camera cannot be moved over the ground, in a sentence.
inline constexpr const char* kWhyCameraIsFixed =
    "The log says where the camera is: it has geodetic positions, and latitude and longitude of the world are stated.";

}  // namespace sigs::editor
