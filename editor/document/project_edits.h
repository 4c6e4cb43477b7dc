// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geo/geodetic.h"
#include "project/project.h"

namespace sigs::editor {

// What is done to the waypoints of a trajectory. They stay in order of time, at least kMinGap apart, whatever is asked.
inline constexpr double kMinGap_frames = 1;

// Adds one at a frame, where it belongs in time; its number. Where one stands within kMinGap of that frame, that one is
// moved to the position instead. Waypoints without a frame of their own are given theirs first (frames_now: where each
// one stands, as scene/scene_parts.h spreads them), so that none of the others moves in time.
//   earth  where the world lies (stated_frame() of project/places.h): among waypoints that all are places on the Earth
//          the new one is a place too; none: it is a point of the world
int put_waypoint(TrajectoryPlan& plan, double frame, const glm::dvec3& position_m,
                 const std::vector<double>& frames_now, const std::optional<LocalFrame>& earth = {});

// Takes one out. The last one stays: an intruder has to be somewhere.
void delete_waypoint(TrajectoryPlan& plan, int waypoint, const std::vector<double>& frames_now);

// A copy between it and the next one, or after the last one, as far on as the one before; the copy's number. The copy
// of a place on the Earth is the place where it is put; without `earth` a point of the world.
int duplicate_waypoint(TrajectoryPlan& plan, int waypoint, const std::vector<double>& frames_now,
                       const std::optional<LocalFrame>& earth = {});

// Puts a waypoint to a point of the world. If it is a place on the Earth it is the place there afterwards; without
// `earth` it is a point of the world alone.
void put_at(WaypointSettings& waypoint, const glm::dvec3& position_m, const std::optional<LocalFrame>& earth);

// In time, between its neighbours.
void move_waypoint_in_time(TrajectoryPlan& plan, int waypoint, double frame, const std::vector<double>& frames_now);

// What is done to the cameras of a project. `whole` is the project as its file has it.

// Adds a camera with this video, at the aircraft's origin looking ahead, called after the video's file; its calibration
// is still to be chosen. A project with one camera becomes a rig, whose first camera, "camera 1", is that one: what it
// shows stays the same to the pixel.
void add_camera(Project& whole, const std::filesystem::path& video);

// Takes one out. The first one stays, as waypoints count its frames and the clock is its. Where it alone is left, and
// sits at the aircraft's origin looking ahead, the project has one camera again, with that one's look.
void remove_camera(Project& whole, std::size_t camera);

// Why a camera cannot be called so, in a sentence; "": it can.
[[nodiscard]] std::string why_not_called(const Project& whole, std::size_t camera, const std::string& name);

}  // namespace sigs::editor
