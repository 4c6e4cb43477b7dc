// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"
#include "scene/scene_files.h"

// The steps in which a scene is made from a project. open_valid_scene fails at the first problem; draft_scene takes a
// placeholder for the part that has it and goes on.
namespace sigs {

// The part, or its problem, by the project's field.

// "intruders[3]"
[[nodiscard]] std::string key_of_intruder(std::size_t intruder);

// The camera's motion without any file: straight on along world X with the platform level.
[[nodiscard]] CameraMotion steady_motion(const Project& project);

// What needs no file and cannot fail: camera motion with the platform level, light, compositing, footage. The lens is a
// default one, there are no intruders, and the range is not set.
[[nodiscard]] Scene bare_scene(const Project& project, const FootageShape& footage);

// First and last frame; a problem where they are not frames of the footage or not in order.
[[nodiscard]] Result<FrameRange, Problem> scene_range(const FootageSettings& settings, const FootageShape& footage);

// Scene::timeline; none where the footage is the first camera's.
[[nodiscard]] Result<std::optional<Timeline>, Problem> scene_timeline(const Project& project, SceneFiles& files);

// Sets first and last frame of a scene and its timeline: scene_range() and, of a further camera of a rig, of that what
// lies between the first and the last frame of the first camera, up to half a frame beyond them; a problem where
// nothing does.
[[nodiscard]] Result<void, Problem> set_range(Scene& scene, const Project& project, SceneFiles& files);

// Whether the footage's lens is stated: by a calibration file or, of 360 degree footage, by the model alone.
[[nodiscard]] inline bool states_lens(const FootageSettings& footage) {
  return !footage.calibration.empty() || !needs_calibration(footage.lens_model);
}

// The calibrated camera, scaled to the footage's size.
[[nodiscard]] Result<Camera, Problem> scene_camera(const Project& project, const FootageShape& footage,
                                                   SceneFiles& files);

// What 360 degree footage cannot be used with: the classic method and plain, a rolling shutter. None where all is well,
// also for footage of any other lens.
//   scene  its camera and motion
[[nodiscard]] std::optional<Problem> panorama_problem(const Scene& scene);

// Attitudes of the platform, by rising time; empty where the project names no attitude file.
[[nodiscard]] Result<std::vector<PlatformAttitude>, Problem> scene_platform_attitudes(const Project& project,
                                                                                      const FootageShape& footage,
                                                                                      SceneFiles& files);

// Scene::occluder; without mask where the project names none.
//   scene  its motion and footage
[[nodiscard]] Result<Occluder, Problem> scene_occluder(const Project& project, const Scene& scene, SceneFiles& files);

// Scene::real_aircraft; empty where the project names no file.
[[nodiscard]] Result<BoxesByFrame, Problem> scene_real_aircraft(const Project& project, SceneFiles& files);

// Scene::own_body; empty where the project names no mask.
[[nodiscard]] Result<cv::Mat, Problem> scene_own_body(const Project& project, cv::Size footage_size_px,
                                                      SceneFiles& files);

// The model of an intruder, by its index in the project.
[[nodiscard]] Result<std::shared_ptr<const Model>, Problem> scene_model(const Project& project, std::size_t intruder,
                                                                        SceneFiles& files);

// The trajectory of an intruder, by its index in the project, over the footage and range of the scene.
[[nodiscard]] Result<Trajectory, Problem> scene_trajectory(const Project& project, std::size_t intruder,
                                                           const Scene& scene);

// A project's trajectory settings in the form of spline/trajectory.h.
//   timed  the plan's waypoints
[[nodiscard]] TrajectorySettings trajectory_settings(const TrajectoryPlan& plan,
                                                     const std::vector<TimedWaypoint>& timed);

// The frame of each waypoint: its own; where it has none, spread evenly between the nearest waypoints that have one.
// The first and the last waypoint without a frame get the first and the last frame of the range.
[[nodiscard]] std::vector<double> waypoint_frames(const std::vector<WaypointSettings>& waypoints, int first_frame,
                                                  int last_frame);
[[nodiscard]] std::vector<double> waypoint_frames(const std::vector<WaypointSettings>& waypoints, const Scene& scene);

// The waypoints with their times (waypoint_frames, time_of_frame_s), ready for Trajectory::make.
[[nodiscard]] std::vector<TimedWaypoint> timed_waypoints(const std::vector<WaypointSettings>& waypoints,
                                                         const FootageShape& footage, int first_frame, int last_frame);
[[nodiscard]] std::vector<TimedWaypoint> timed_waypoints(const std::vector<WaypointSettings>& waypoints,
                                                         const Scene& scene);

// Appends an intruder to the scene. A model that the scene does not have yet is added, with its mesh's warnings.
void add_intruder(Scene& scene, const std::string& name, const std::shared_ptr<const Model>& model,
                  const Trajectory& trajectory);

}  // namespace sigs
