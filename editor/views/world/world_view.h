// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/geometry/gizmo.h"
#include "editor/geometry/lens_projection.h"
#include "editor/geometry/orbit_camera.h"
#include "editor/views/context.h"
#include "editor/views/encounter/approach_edit.h"
#include "editor/views/world/scene.h"
#include "editor/widgets/gizmo_handle.h"

namespace sigs::editor {

// What the mouse is at in the world view: something that can be selected, else a trajectory.
struct WorldPick {
  Selection what;
  std::optional<double> frame;  // of the trajectory of what.intruder, where nothing else is at the mouse
};

// The nearest within reach of the mouse, which is on the screen; waypoints before aircraft, camera and light, of equals
// the one that is worked on. Kind nothing: there is none.
[[nodiscard]] WorldPick pick_at(const WorldCanvas& canvas, const WorldContext& world, const glm::dvec2& mouse);

// A point of the world that a handle moves, and how.
struct Movable {
  Selection what;
  std::string title;         // "Waypoint at frame 150"
  glm::dvec3 at_m{0, 0, 0};  // in the world
};
// It, if it can be moved: a waypoint, the light, the camera (where it is at the playhead), unless its log says where it
// is (movable_axes()).
[[nodiscard]] std::optional<Movable> movable(const WorldContext& world, const Selection& what);
// Part of a gesture, of this name.
[[nodiscard]] std::string gesture_of(const Selection& moved);
// Queues the edit that moves it, as part of the gesture gesture_of(moved.what).
void move_to(const WorldContext& world, const Movable& moved, const glm::dvec3& to_m);

// Where a waypoint put at a place of the screen is to be: at the height of the intruder that is worked on; where the
// view looks along that plane, upright through the intruder. None where the plane is not under the mouse.
[[nodiscard]] std::optional<glm::dvec3> place_for_waypoint(const WorldCanvas& canvas, const WorldContext& world,
                                                           const glm::dvec2& mouse);

// Where the world view looks from: from behind and above, straight from above, from the right-hand side, or from behind
// the project's camera.
enum class WorldViewPreset { orbit, top, side, camera };

// The camera of the world view and its switches. Not part of the project.
struct WorldViewState {
  OrbitCamera eye;
  WorldViewPreset preset = WorldViewPreset::orbit;
  bool snap = false;     // drags go in round steps; holding Ctrl turns it round
  bool volumes = false;  // the volumes of well clear are drawn around the camera
  // The user has moved the camera since the project was opened: it is not framed anew by itself.
  bool touched = false;
};

// The handle of the closest approach, a diamond where the current intruder is then. Dragged, it moves the miss sideways
// and in height, perpendicular to the horizontal relative motion: speed, bearing and time stay. One undo step; Escape
// takes it back. A double click goes to its frame.
class ApproachHandle {
 public:
  // Once per update, before anything is picked.
  //   mouse_is_free  over the canvas, nothing else has it or is nearer to it
  //   snap_m         > 0: misses are rounded to multiples of it
  void update(const WorldContext& world, const WorldCanvas& canvas, bool mouse_is_free, double snap_m);
  // The mouse is over it, or drags it: presses are its own.
  [[nodiscard]] bool has_mouse() const { return is_hovered_ || is_dragging(); }
  [[nodiscard]] bool is_dragging() const { return start_.has_value(); }
  // While it is dragged, under the view: the misses, or why there is no such encounter.
  [[nodiscard]] std::vector<std::string> readout() const;
  void draw(WorldCanvas& canvas, const WorldContext& world);

 private:
  // What is drawn, as dragged; none: there is no closest approach.
  [[nodiscard]] std::optional<PresentApproach> shown(const ViewContext& context);
  void press(const ViewContext& context, int intruder);
  void drag(const ViewContext& context, const WorldCanvas& canvas, double snap_m);

  PresentApproachMemory memory_;
  bool is_hovered_ = false;
  // Since the press: what the drag starts from, and in which plane it moves.
  std::optional<ApproachStart> start_;
  PlaneDrag plane_;
  DragGesture gesture_;
  PlannedApproach wish_;  // where the mouse has brought it
  std::string reason_;    // why the last step could not be done
  // The wish of a drag that is over, until the scene shows it.
  std::optional<PresentApproach> left_;
};

// A level ring around the selected waypoint of an aircraft that has headings of its own (trajectory.attitude), with a
// knob where its nose points; hollow where the other waypoints or the path decide. Dragged, it gives the waypoint a
// heading: one undo step; Escape takes it back. Where the ring is seen nearly edge on there is none.
class HeadingRing {
 public:
  // Once per update, before anything is picked.
  //   mouse_is_free  over the canvas, nothing else has it
  //   snaps          headings are rounded to 5 degrees, else to a tenth
  void update(const WorldContext& world, const WorldCanvas& canvas, bool mouse_is_free, bool snaps);
  // The mouse is over its knob, or drags it: presses are its own.
  [[nodiscard]] bool has_mouse() const { return is_hovered_ || is_dragging(); }
  [[nodiscard]] bool is_dragging() const { return dragged_.has_value(); }
  // While it is dragged, under the view.
  [[nodiscard]] std::vector<std::string> readout(const WorldContext& world) const;
  void draw(WorldCanvas& canvas, const WorldContext& world) const;

 private:
  struct Target {
    Selection waypoint;
    glm::dvec3 center_m{0, 0, 0};
    double heading_rad = 0;  // from world X to the right
    bool is_given = false;   // the waypoint has it
  };
  struct Shape {
    std::vector<glm::dvec3> ring_m;
    glm::dvec3 nose_m{0, 0, 0};  // on the ring, where the nose points
    glm::dvec2 knob{0, 0};       // the same on the screen
  };
  [[nodiscard]] std::optional<Target> target_of(const WorldContext& world) const;
  [[nodiscard]] static std::optional<Shape> shape_of(const Target& target, const WorldCanvas& canvas);
  void drag(const WorldContext& world, const WorldCanvas& canvas, bool snaps);

  bool is_hovered_ = false;
  std::optional<Selection> dragged_;
  DragGesture gesture_;
  int gestures_ = 0;
};

// The menu of the right button, for what was under the mouse when it was clicked.
class WorldMenu {
 public:
  // place_m: where a new waypoint would be, in the world; nothing where the mouse is beside the plane for waypoints.
  void open(const WorldPick& pick, const std::optional<glm::dvec3>& place_m);
  // Once per update. Returns what the user wants to type a position for, in the update in which that is chosen; what
  // else is chosen goes into the context's edits.
  [[nodiscard]] std::optional<Selection> draw(const WorldContext& world);

 private:
  enum class State { closed, asked, open };

  [[nodiscard]] std::optional<Selection> draw_items(const WorldContext& world) const;

  State state_ = State::closed;
  // What was under the mouse when it was opened.
  WorldPick pick_;
  std::optional<glm::dvec3> place_m_;
};

// The mouse in the world view. Drags beside everything orbit or pan the camera of the view, the wheel zooms, a click
// selects, a drag of the selected point's handle moves it in the project (one undo step; Escape takes it back), and the
// right button opens a menu.
class WorldTools {
 public:
  // Once per update, right after the canvas' ImGui item and before anything is drawn. Changes `look` (camera, preset).
  void update(const WorldContext& world, const WorldCanvas& canvas, WorldViewState& look);
  // Before labels are drawn: keeps the handle's area free of them.
  void keep_handle_free(WorldCanvas& canvas, const WorldContext& world) const;
  // After the world: draws the handle, the field for typed coordinates and the menu.
  void draw(WorldCanvas& canvas, const WorldContext& world, const WorldViewState& look);

  // What is under the mouse while nothing is held; the views draw it highlighted.
  [[nodiscard]] const WorldPick& hovered() const { return hovered_; }
  // Whether the project's camera is being dragged.
  [[nodiscard]] bool moves_camera() const { return handle_.dragging() && dragged_.kind == Selected::camera; }

 private:
  // What a press beside the handle has become: orbiting or panning the view, or a menu when it is let go.
  enum class Holding { nothing, orbit, pan, menu };

  // What the handle is at: what is dragged, else what is selected, if it can be moved.
  [[nodiscard]] std::optional<Movable> target_of(const WorldContext& world) const;
  // The heading's knob, then the closest approach, take the mouse where nothing nearer has it.
  void move_heading(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look);
  void move_approach(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look);
  // Lets the handle of what is selected take the mouse, and moves that point.
  void move_handle(const WorldContext& world, const WorldCanvas& canvas, const WorldViewState& look);
  void begin_drag(const WorldContext& world, const Movable& moved);
  void press(const WorldContext& world, const WorldCanvas& canvas);
  void hold(const ScreenRect& rect, WorldViewState& look);
  void release(const WorldContext& world, const WorldCanvas& canvas);
  // Opens the field for typed coordinates, where `what` can be moved.
  void enter_position(const WorldContext& world, const Selection& what);
  void draw_entry(const WorldContext& world);
  void draw_readout(WorldCanvas& canvas, const Movable& moved, double snap_m) const;

  GizmoHandle handle_;
  ApproachHandle approach_;
  HeadingRing heading_;
  // What the handle moves while it is dragged.
  Selection dragged_;
  DragGesture gesture_;
  // Where it was moved to in this update, in the world: the document has it only in the next.
  std::optional<glm::dvec3> moved_to_;
  PointEntry entry_;
  // What a position is typed for.
  Selection entered_;
  WorldMenu menu_;
  Holding holding_ = Holding::nothing;
  // How far the mouse has gone since the press, in screen pixels: a short way is a click.
  double held_px_ = 0;
  WorldPick hovered_;
};

// The world from outside: camera path, view frustum, intruders, trajectories, light; waypoints, the light and the
// camera are moved with a handle. It shows the newest scene that is open, with the document's camera.
class WorldView {
 public:
  // Once per update, into what is left of the current ImGui window: toolbar and view. In less than 16 pixels it draws
  // nothing.
  void draw(const ViewContext& context);

 private:
  // Frames a project that was opened, and once more when its trajectories are known, unless the person has looked
  // around.
  void look_at_opened_project(const WorldContext& world, const ScreenRect& rect);
  // While looking from behind the project's camera, moves with it.
  void go_with_camera(const WorldContext& world);
  void draw_world(WorldCanvas& canvas, const WorldContext& world);

  WorldViewState look_;
  std::shared_ptr<const OpenedScene> scene_;  // that was open last
  WorldModel model_;                          // of it
  RigBorders borders_;
  BodyShapes shapes_;
  WorldTools tools_;
  // Number of the first revision of the project that is looked at; 0: none.
  std::uint64_t opened_revision_ = 0;
  bool framed_with_scene_ = false;  // it has been framed with all its trajectories known
  // Where the project's camera was in the update before, in the world.
  std::optional<glm::dvec3> camera_m_;
};

}  // namespace sigs::editor
