// SPDX-License-Identifier: MIT
#include "scene/scene.h"

#include <cmath>
#include <utility>

#include "project/validate.h"
#include "scene/plausibility.h"
#include "scene/scene_files.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace {

Result<Scene> opened(const Project& project, const FootageShape& footage, SceneFiles& files) {
  const auto stop = [&](const Problem& problem) { return fail(error_of(project, problem)); };
  Scene scene = bare_scene(project, footage);
  const OrProblem<FrameRange> range = scene_range(project.footage, footage);
  if (!range) return stop(range.error());
  scene.first_frame = range->first;
  scene.last_frame = range->last;
  OrProblem<Camera> camera = scene_camera(project, footage.size_px, files);
  if (!camera) return stop(camera.error());
  scene.camera = *std::move(camera);
  OrProblem<std::vector<CarrierAttitude>> turns = scene_carrier_attitudes(project, footage, files);
  if (!turns) return stop(turns.error());
  scene.motion.turns = *std::move(turns);
  const OrProblem<cv::Mat> own_body = scene_own_body(project, footage.size_px, files);
  if (!own_body) return stop(own_body.error());
  scene.own_body = *own_body;
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const OrProblem<std::shared_ptr<const Model>> model = scene_model(project, i, files);
    if (!model) return stop(model.error());
    const OrProblem<Trajectory> trajectory = scene_trajectory(project, i, scene);
    if (!trajectory) return stop(trajectory.error());
    add_intruder(scene, project.intruders[i].name, *model, *trajectory);
  }
  scene.issues = plausibility_issues(project, scene);
  return scene;
}

}  // namespace

Result<Scene> open_scene(const Project& project, const FootageShape& footage, SceneFiles& files) {
  if (const std::vector<Problem> problems = validate(project); !problems.empty())
    return fail(error_of(project, problems.front()));
  return opened(project, footage, files);
}

Result<Scene> open_scene(const Project& project, const FootageShape& footage) {
  SceneFiles files;
  return open_scene(project, footage, files);
}

double time_of_frame_s(const FootageShape& footage, double frame) {
  const std::vector<double>& times_s = footage.times_s;
  const double last = static_cast<double>(times_s.size()) - 1;
  if (times_s.empty()) return frame * footage.frame_interval_s;
  if (frame <= 0) return times_s.front() + frame * footage.frame_interval_s;
  if (frame >= last) return times_s.back() + (frame - last) * footage.frame_interval_s;
  const double whole = std::floor(frame);
  const double share = frame - whole;
  const auto index = static_cast<std::size_t>(whole);
  return share == 0 ? times_s[index] : times_s[index] + share * (times_s[index + 1] - times_s[index]);
}

}  // namespace sigs
