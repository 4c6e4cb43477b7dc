// SPDX-License-Identifier: MIT
#include "editor/views/context.h"

#include "scene/scene_at.h"
#include "scene/scene_parts.h"

namespace sigs::editor {

namespace {

constexpr double kUsualInterval_s = 0.04;

// Null: no scene is open.
const CameraMotion* motion_of(const ViewContext& context) {
  return context.shown.scene ? &context.shown.scene->draft.scene.motion : nullptr;
}

}  // namespace

CameraPose camera_pose_at(const Project& project, double time_s) {
  return camera_at(steady_motion(project), time_s);
}

CameraPose camera_pose_at(const ViewContext& context, double time_s) {
  const CameraMotion* const motion = motion_of(context);
  if (motion == nullptr) return camera_pose_at(context.project(), time_s);
  CameraMotion stated = steady_motion(context.project());
  const auto mount = std::exchange(stated.mount, std::nullopt);
  CameraPose pose = camera_at(stated, time_s);
  pose.rotation = world_from_platform_at(motion->attitudes, time_s) * pose.rotation;
  if (motion->path) pose.translation_m = motion->path->motion_at(time_s).position_m + path_shift_m(context);
  return mount ? Pose<frame::World, frame::Body>{pose.rotation, pose.translation_m} * *mount : pose;
}

double time_of(const ViewContext& context, double frame) {
  if (!context.shown.scene) return frame * kUsualInterval_s;
  return time_of_frame_s(context.shown.scene->draft.scene.footage, frame);
}

glm::dvec3 path_shift_m(const ViewContext& context) {
  const CameraMotion* const motion = motion_of(context);
  if (motion == nullptr || !motion->path || !context.shown.scene->project) return {0, 0, 0};
  const glm::dvec3 shift_m = context.project().camera.position_m - context.shown.scene->project->camera.position_m;
  return glm::mix(glm::dvec3(0), shift_m, motion->moves_with_start);
}

bool is_turned_by_file(const ViewContext& context) {
  const CameraMotion* const motion = motion_of(context);
  return !context.project().camera.attitude_file.empty() || (motion != nullptr && !motion->attitudes.empty());
}

glm::bvec3 movable_axes(const ViewContext& context) {
  const CameraMotion* const motion = motion_of(context);
  return motion != nullptr && motion->path ? motion->moves_with_start : glm::bvec3(true);
}

}  // namespace sigs::editor
