// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"

namespace sigs {

// Bounds of the size and speed of aircraft. The fastest aircraft with a crew and jet engines, the SR-71, flew at some
// 980 m/s; airships were up to 245 m long, aeroplanes up to 120 m wide.
inline constexpr double kFastestAircraft_mps = 1000;
inline constexpr double kMaxAircraft_m = 300;
inline constexpr double kMinAircraft_m = 0.1;

// Settings that can be used but are implausible, in the project's order of fields: calibrations with warnings, an
// own-body mask that covers nearly everything or nothing, a camera below the ground (z > 0), models larger or smaller
// than any aircraft, trajectories faster than any aircraft or below the ground, and paths that overshoot farther off
// the straight line between two waypoints than the legs around are long; and clouds, shadows, contrails and lights that
// the compositing method, the light or thermal footage leaves out. What lint() finds follows for each intruder.
// Trajectories are sampled at each frame, at fewer frames where intruders or frames are very many. Whether an intruder is ever visible: scene/visibility.h.
//   intruder_of_project  for each of the project's intruders its index in scene.intruders; -1: it is not in the scene
[[nodiscard]] std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene,
                                                       const std::vector<int>& intruder_of_project);

// The same for a scene that has all intruders in the project's order, as open_scene gives it.
[[nodiscard]] std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene);

// Condition number of the interpolation through the intruder's waypoints over the scene's range of frames
// (spline/trajectory.h): large where neighbouring legs last very differently long. None for an approximating
// spline, whose shape does not depend on times. The waypoints must make a trajectory.
//   intruder  index in project.intruders
[[nodiscard]] std::optional<double> path_condition(const Project& project, std::size_t intruder, const Scene& scene);

// What those who begin often get wrong, with what to do about it. Each is one line in the field to be changed.

// Of an intruder's model and waypoints: axes that do not go with the shape of the model (mesh/geometry.h), waypoints
// whose frames the footage does not have, and positions that look as if they were in kilometres or had z pointing up.
// Distractors, which have other shapes than aircraft, are checked for waypoints alone.
//   intruder        index in the project's intruders
//   scene_intruder  the same in the scene
[[nodiscard]] std::vector<Problem> lint(const Project& project, std::size_t intruder, const Scene& scene,
                                        std::size_t scene_intruder);

// Where an intruder that is never in the image passes it: "at frame 12 it is nearest to the image, 40 degrees left of
// it"; "it is behind the camera". Of the reference point alone, at 200 frames at most. Empty where it is in the image.
//   intruder  index in scene.intruders
[[nodiscard]] std::string where_out_of_view(const Scene& scene, std::size_t intruder);

// What footage has that an intruder cannot follow, in the field footage.video: the camera's stabilisation has moved the
// images, as the header or the log in the video says. Reads both; a long recording's log takes a second.
//   log  that the camera follows; one with the attitudes of the images makes it no mistake. Empty: none
[[nodiscard]] std::vector<Problem> footage_mistakes(const std::filesystem::path& video,
                                                    const std::filesystem::path& log = {});

}  // namespace sigs
