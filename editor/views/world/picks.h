// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "editor/views/world/scene.h"

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
// What is selected, if it can be moved: a waypoint, the light, the camera (where it is at the
// playhead), unless its log says where it is (movable_axes()).
[[nodiscard]] std::optional<Movable> movable(const WorldContext& world);
[[nodiscard]] std::optional<Movable> movable(const WorldContext& world, const Selection& what);
// Part of a gesture, of this name.
[[nodiscard]] std::string gesture_of(const Selection& moved);
// Queues the edit that moves it, as part of the gesture gesture_of(moved.what).
void move_to(const WorldContext& world, const Movable& moved, const glm::dvec3& to_m);

// Where a waypoint put at a place of the screen is to be: at the height of the intruder that is worked on; where the
// view looks along that plane, upright through the intruder. None where the plane is not under the mouse.
[[nodiscard]] std::optional<glm::dvec3> place_for_waypoint(const WorldCanvas& canvas, const WorldContext& world,
                                                           const glm::dvec2& mouse);

}  // namespace sigs::editor
