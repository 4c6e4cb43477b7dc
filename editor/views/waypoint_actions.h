// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/views/context.h"

namespace sigs::editor {

// What keys, buttons and menus do to waypoints, each in one place.

// The intruder that is worked on: the selected one, else the only or first one. None where the project has none.
[[nodiscard]] std::optional<int> current_intruder(const ViewContext& context);

// Where each of an intruder's waypoints stands in time.
[[nodiscard]] std::vector<double> frames_of_waypoints(const ViewContext& context, int intruder);

// Where an intruder is in a frame, in the world, by the newest scene that is open; none where it cannot be told.
[[nodiscard]] std::optional<glm::dvec3> position_of(const ViewContext& context, int intruder, double frame);

// In the playhead's frame, on the trajectory, or where it is said; selects it.
void add_waypoint_here(const ViewContext& context, std::optional<glm::dvec3> position_m = std::nullopt);
void add_waypoint(const ViewContext& context, int intruder, double frame, const glm::dvec3& position_m);
void delete_selected(const ViewContext& context);     // a waypoint, or a whole intruder
void duplicate_selected(const ViewContext& context);  // the same
void delete_intruder(const ViewContext& context, int intruder);
void duplicate_intruder(const ViewContext& context, int intruder);

// The playhead to the waypoint before (-1) or after (+1) it; selects that.
void go_to_waypoint(const ViewContext& context, int direction);

// Moves one, as part of a drag; ends with context.edits.end_gesture(). The gesture's name, for taking it back.
[[nodiscard]] std::string gesture_of_waypoint(int intruder, int waypoint);
void move_waypoint(const ViewContext& context, int intruder, int waypoint, const glm::dvec3& position_m);

// An intruder of the same model as the last one (or none) 300 m ahead of the camera, crossing. Adding selects it.
[[nodiscard]] IntruderSettings new_intruder(const ViewContext& context);
void add_intruder(const ViewContext& context);

}  // namespace sigs::editor
