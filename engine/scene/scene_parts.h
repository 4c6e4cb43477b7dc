// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"
#include "scene/scene_files.h"

namespace sigs {

// The steps in which a scene is made of a project. open_scene stops at the first problem, draft_scene stands in for
// what could not be made and goes on.
template <class T>
using OrProblem = tl::expected<T, Problem>;

// What needs no file and cannot fail: motion with the carrier level, light, compositing, footage; no lens yet.
[[nodiscard]] Scene bare_scene(const Project& project, const FootageShape& footage);

[[nodiscard]] OrProblem<FrameRange> scene_range(const FootageSettings& settings, const FootageShape& footage);
[[nodiscard]] OrProblem<Camera> scene_camera(const Project& project, cv::Size footage_size_px, SceneFiles& files);

// None: as the file says, or as it looks.
[[nodiscard]] std::optional<LensModel> lens_model_of(LensModelChoice choice);

// Empty where the project names no attitude file.
[[nodiscard]] OrProblem<std::vector<CarrierAttitude>> scene_carrier_attitudes(const Project& project,
                                                                              const FootageShape& footage,
                                                                              SceneFiles& files);

// Empty where the project names none.
[[nodiscard]] OrProblem<cv::Mat> scene_own_body(const Project& project, cv::Size footage_size_px, SceneFiles& files);

[[nodiscard]] OrProblem<std::shared_ptr<const Model>> scene_model(const Project& project, std::size_t intruder,
                                                                  SceneFiles& files);

// Of the project's intruder, over the scene's footage and range.
[[nodiscard]] OrProblem<Trajectory> scene_trajectory(const Project& project, std::size_t intruder, const Scene& scene);

[[nodiscard]] TrajectorySettings trajectory_settings(const TrajectoryPlan& plan);

// "intruders[3]"
[[nodiscard]] std::string key_of_intruder(std::size_t intruder);

// Gives the scene an intruder, and its model with its warnings where the scene has not got it yet.
void add_intruder(Scene& scene, const std::string& name, const std::shared_ptr<const Model>& model,
                  const Trajectory& trajectory);

}  // namespace sigs
