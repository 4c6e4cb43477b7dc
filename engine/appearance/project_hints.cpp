// SPDX-License-Identifier: MIT
#include "appearance/project_hints.h"

#include <memory>
#include <optional>
#include <utility>

#include "project/validate.h"
#include "scene/camera_track.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "scene/scene_light.h"

namespace sigs {

namespace {

struct KnownCamera {
  Scene scene;
  bool has_calibration = false;
  bool has_height = false;
  cv::Mat own_body;  // CV_8UC1
};

View view_at(const KnownCamera& known, int frame) {
  const double time_s = time_of_frame_s(known.scene.footage, frame);
  const Pose<frame::World, frame::Camera> pose = camera_at(known.scene.motion, time_s);
  View view{.camera = known.has_calibration ? &known.scene.camera : nullptr, .own_body = known.own_body};
  if (known.scene.horizon_is_known) view.world_from_camera = pose.rotation;
  if (known.has_height && pose.translation_m.z < 0)
    view.height_m = -pose.translation_m.z;  // the ground is the world's plane z = 0
  return view;
}

AppearanceHints hints_by(std::shared_ptr<KnownCamera> known) {
  AppearanceHints hints{.view = [known](int frame) { return view_at(*known, frame); }};
  known->scene.light = {};  // the direction that the project states must not stand for the computed one
  if (known->scene.earth && known->scene.utc_at_frame_0_s)
    hints.to_sun_in_world = [known](int frame) {
      return sunlight_at(known->scene, time_of_frame_s(known->scene.footage, frame)).to_sun;
    };
  return hints;
}

}  // namespace

AppearanceHints hints_of(const Scene& scene) {
  return hints_by(std::make_shared<KnownCamera>(KnownCamera{.scene = scene, .has_calibration = true}));
}

Result<AppearanceHints> hints_of(const Project& project, const VideoInfo& footage, bool height_is_guess,
                                 const std::function<void(const Warning&)>& warn) {
  const auto failed = [&](const Problem& problem) { return fail(error_of(project, problem)); };
  const auto known = std::make_shared<KnownCamera>(
      KnownCamera{.scene = bare_scene(project, shape_of(footage)), .has_height = !height_is_guess});
  Scene& scene = known->scene;
  const Result<FrameRange, Problem> range = scene_range(project.footage, scene.footage);
  if (!range) return failed(range.error());
  SceneFiles files;
  if (!project.footage.calibration.empty()) {
    Result<Camera, Problem> camera = scene_camera(project, footage.size_px, files);
    if (!camera) return failed(camera.error());
    scene.camera = *std::move(camera);
    known->has_calibration = true;
  }
  Result<CameraFlight, Problem> flight = camera_flight(project, scene.footage, *range, files);
  if (!flight) return failed(flight.error());
  set_camera_motion(scene, *std::move(flight));
  const Result<cv::Mat, Problem> own_body = scene_own_body(project, footage.size_px, files);
  if (!own_body) return failed(own_body.error());
  if (!own_body->empty()) own_body->convertTo(known->own_body, CV_8U, 255);
  for (const Warning& warning : scene.warnings) warn(warning);
  return hints_by(known);
}

}  // namespace sigs
