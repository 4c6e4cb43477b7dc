// SPDX-License-Identifier: MIT
#include "editor/views/viewport/footage_camera.h"

#include "editor/views/waypoint_actions.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

Lens lens_of(const Scene& scene) {
  if (scene.compositing.method != MethodChoice::plain) return scene.camera.lens;
  const LensParameters& lens = scene.camera.lens.parameters();
  return Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}).value_or(scene.camera.lens);
}

}  // namespace

std::optional<FootageCamera> footage_camera_at(const ViewContext& context, int frame) {
  if (!context.shown.scene) return std::nullopt;
  const Scene& scene = context.shown.scene->draft.scene;
  return FootageCamera{frame, camera_at(scene.motion, time_of_frame_s(scene.footage, frame)), lens_of(scene)};
}

const std::vector<WaypointMark>& WaypointMarks::of(const ViewContext& context, const FootageCamera& eye) {
  const MadeFor wanted{context.document.revision().number, context.shown.scene ? context.shown.scene->revision : 0,
                       eye.frame};
  if (wanted == made_for_) return marks_;
  made_for_ = wanted;
  marks_.clear();
  const std::vector<IntruderSettings>& intruders = context.project().intruders;
  for (std::size_t i = 0; i < intruders.size(); ++i) {
    const std::vector<double> frames = frames_of_waypoints(context, static_cast<int>(i));
    const std::vector<WaypointSettings>& waypoints = intruders[i].trajectory.waypoints;
    for (std::size_t k = 0; k < waypoints.size() && k < frames.size(); ++k) {
      const std::optional<glm::dvec2> pixel = pixel_of(waypoints[k].position_m, eye.world_from_camera, eye.lens);
      if (pixel)
        marks_.push_back({static_cast<int>(i), static_cast<int>(k), frames[k], waypoints[k].position_m, *pixel});
    }
  }
  return marks_;
}

std::optional<int> project_intruder(const ViewContext& context, int in_scene) {
  if (!context.shown.scene) return std::nullopt;
  const std::vector<int>& numbers = context.shown.scene->draft.intruder_of_project;
  for (std::size_t i = 0; i < numbers.size() && i < context.project().intruders.size(); ++i)
    if (numbers[i] == in_scene) return static_cast<int>(i);
  return std::nullopt;
}

std::optional<int> scene_intruder(const ViewContext& context, int in_project) {
  if (!context.shown.scene || in_project < 0) return std::nullopt;
  const std::vector<int>& numbers = context.shown.scene->draft.intruder_of_project;
  const auto index = static_cast<std::size_t>(in_project);
  if (index >= numbers.size() || numbers[index] < 0) return std::nullopt;
  return numbers[index];
}

}  // namespace sigs::editor
