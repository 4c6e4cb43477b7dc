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

// The index in the project of an intruder given by its index in the scene (as FrameTruth and stages count). The scene
// leaves out intruders without waypoints. Nothing while no scene is open and for an index that it does not have. Both
// this and the next go by the scene that is open, which may be of an older revision than the document.
[[nodiscard]] std::optional<int> project_intruder(const ViewContext& context, int in_scene);

// The index in the scene of an intruder given by its index in the project; nothing for one without waypoints.
[[nodiscard]] std::optional<int> scene_intruder(const ViewContext& context, int in_project);

// What is known without rendering of an intruder given by its index in the project; null: nothing yet.
[[nodiscard]] std::shared_ptr<const Survey> survey_of(const ViewContext& context, int intruder);
// Null: the project has no such waypoint.
[[nodiscard]] const WaypointSettings* waypoint_of(const Project& project, int intruder, int waypoint);
// The moment of each of an intruder's waypoints, in frames of the footage; not whole where frames are spread evenly.
[[nodiscard]] std::vector<double> frames_of_waypoints(const ViewContext& context, int intruder);
[[nodiscard]] double frame_of_waypoint(const ViewContext& context, int intruder, int waypoint);

// Whether an edit may give every waypoint of an intruder the frame at which it stands now. Not where some are spread
// evenly over a range that nobody knows, as the footage is missing or not open yet: then a message says so.
[[nodiscard]] bool can_fix_frames(const ViewContext& context, int intruder);

// Whether its waypoints have headings of their own: what flies along its nose has none.
[[nodiscard]] bool has_headings(const ViewContext& context, int intruder);
// Turns the nose at a waypoint, in degrees from world X to the right; none: as the other waypoints or the path have it.
void turn_waypoint(const ViewContext& context, int intruder, int waypoint, std::optional<double> heading_deg,
                   const std::string& gesture);

// Where an intruder is in a frame (world, metres), by the newest scene that is open; nothing where no scene is open or
// the intruder is not in it.
[[nodiscard]] std::optional<glm::dvec3> position_of(const ViewContext& context, int intruder, double frame);

// Adds a waypoint in the playhead's frame, at position_m (world) or, without one, where the trajectory is in that
// frame; selects it.
void add_waypoint_here(const ViewContext& context, std::optional<glm::dvec3> position_m = std::nullopt);
void add_waypoint(const ViewContext& context, int intruder, double frame, const glm::dvec3& position_m);
void delete_selected(const ViewContext& context);     // a waypoint, or a whole intruder
void duplicate_selected(const ViewContext& context);  // the same
void delete_intruder(const ViewContext& context, int intruder);
void duplicate_intruder(const ViewContext& context, int intruder);

// Playing stops and the playhead goes to a frame, or to the frame that is nearest to a moment (in frames, 0..1e9).
void go_by_hand(const ViewContext& context, int frame);
void go_to_moment(const ViewContext& context, double frame);

// The playhead to the waypoint before (-1) or after (+1) it; selects that.
void go_to_waypoint(const ViewContext& context, int direction);

// The gesture's name for moves of a waypoint that may join one undo step.
[[nodiscard]] std::string gesture_of_waypoint(int intruder, int waypoint);

// An intruder of the same model as the last one (or none) 300 m ahead of the camera, crossing. Adding selects it.
[[nodiscard]] IntruderSettings new_intruder(const ViewContext& context);
void add_intruder(const ViewContext& context);

}  // namespace sigs::editor
