// SPDX-License-Identifier: MIT
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/angles.h"
#include "project/validate.h"
#include "scene/measuring_points.h"
#include "scene/own_body_mask.h"
#include "scene/waypoint_times.h"

namespace sigs {

namespace {

// The project's own words for where something is: "x.json: footage.calibration".
std::string place(const Project& project, const std::string& field) {
  return project.file.string() + ": " + field;
}

// What a room says of a file, said of the field that names the file.
Error in_field(const Project& project, const std::string& field, const Error& error) {
  return {place(project, field), error.text(), error.kind};
}

Result<void> set_range(const Project& project, const FootageShape& footage, Scene& scene) {
  const int count = static_cast<int>(footage.times_s.size());
  scene.first_frame = project.footage.first_frame;
  scene.last_frame = project.footage.last_frame.value_or(count - 1);
  const std::string held = "the footage has " + std::to_string(count) + " frames, 0 to " + std::to_string(count - 1);
  if (scene.first_frame < 0 || scene.first_frame >= count)
    return fail(place(project, "footage.first_frame"), held, ErrorKind::bad_project);
  if (scene.last_frame < scene.first_frame || scene.last_frame >= count)
    return fail(place(project, "footage.last_frame"), held, ErrorKind::bad_project);
  return {};
}

Result<void> set_camera(const Project& project, const FootageShape& footage, Scene& scene) {
  const Result<Camera> camera = read_calibration(resolved(project, project.footage.calibration), footage.size_px);
  if (!camera) return fail(in_field(project, "footage.calibration", camera.error()));
  scene.camera = *camera;
  const CameraSettings& settings = project.camera;
  const Attitude attitude{rad_of_deg(settings.roll_deg), rad_of_deg(settings.pitch_deg), rad_of_deg(settings.yaw_deg)};
  scene.motion = {.world_from_camera_at_start = {rotation_of(attitude), settings.position_m},
                  .speed_mps = settings.speed_mps};
  return {};
}

Result<void> set_own_body(const Project& project, const FootageShape& footage, Scene& scene) {
  if (project.footage.own_body_mask.empty()) return {};
  const Result<cv::Mat> mask = read_own_body_mask(resolved(project, project.footage.own_body_mask), footage.size_px);
  if (!mask) return fail(in_field(project, "footage.own_body_mask", mask.error()));
  scene.own_body = *mask;
  return {};
}

ModelAxes axes_of(const ModelSettings& model) {
  return {.forward = model.forward,
          .up = model.up,
          .scale = model.scale,
          .length_m = model.length_m,
          .anchor_at_bounds = model.anchor == AnchorChoice::bounds};
}

// Two intruders that fly the same file the same way share one mesh.
std::string key_of(const std::filesystem::path& file, const ModelSettings& model) {
  return file.lexically_normal().string() + '\n' + model.forward + model.up + std::to_string(model.scale) + ' ' +
         std::to_string(model.length_m) + (model.anchor == AnchorChoice::bounds ? 'b' : 'o');
}

class ModelShelf {
 public:
  explicit ModelShelf(Scene& scene) : scene_(scene) {}

  Result<const Model*> take(const std::filesystem::path& file, const ModelSettings& model) {
    const std::string key = key_of(file, model);
    if (const auto known = models_.find(key); known != models_.end()) return known->second;
    Result<Mesh> mesh = read_obj(file, axes_of(model));
    if (!mesh) return fail(mesh.error());
    scene_.warnings.insert(scene_.warnings.end(), mesh->warnings.begin(), mesh->warnings.end());
    std::vector<glm::vec3> points_m = measuring_points(*mesh);
    scene_.models.push_back(std::make_unique<const Model>(Model{std::move(*mesh), std::move(points_m)}));
    return models_[key] = scene_.models.back().get();
  }

 private:
  Scene& scene_;
  std::map<std::string, const Model*> models_;
};

TrajectorySettings settings_of(const TrajectoryPlan& plan) {
  return {.spline = plan.spline == SplineChoice::interpolating ? SplineKind::interpolating : SplineKind::approximating,
          .timing = plan.timing == TimingChoice::frames ? Timing::frames : Timing::constant_speed,
          .bank = plan.bank == BankChoice::coordinated ? Bank::coordinated : Bank::level,
          .bank_limit_rad = rad_of_deg(plan.bank_limit_deg)};
}

std::string frame_text(const WaypointSettings& waypoint, double frame) {
  std::ostringstream text;
  text << frame << (waypoint.frame ? "" : " (spread over the project's frames)");
  return text.str();
}

Result<Trajectory> trajectory_of(const Project& project, const std::string& key, const TrajectoryPlan& plan,
                                 const Scene& scene) {
  const std::vector<double> frames = waypoint_frames(plan.waypoints, scene.first_frame, scene.last_frame);
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames[i] <= frames[i - 1])
      return fail(place(project, key + ".trajectory.waypoints[" + std::to_string(i) + "].frame"),
                  "is " + frame_text(plan.waypoints[i], frames[i]) + ", not after waypoints[" + std::to_string(i - 1) +
                      "], which has " + frame_text(plan.waypoints[i - 1], frames[i - 1]),
                  ErrorKind::bad_project);
  const Result<Trajectory> trajectory = Trajectory::make(
      timed_waypoints(plan.waypoints, scene.footage, scene.first_frame, scene.last_frame), settings_of(plan));
  if (!trajectory)
    return fail(place(project, key + ".trajectory." + trajectory.error().where), trajectory.error().what,
                ErrorKind::bad_project);
  return trajectory;
}

Result<void> set_intruders(const Project& project, Scene& scene) {
  ModelShelf shelf(scene);
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const IntruderSettings& settings = project.intruders[i];
    const std::string key = "intruders[" + std::to_string(i) + "]";
    const Result<const Model*> model = shelf.take(resolved(project, settings.model.file), settings.model);
    if (!model) return fail(in_field(project, key + ".model.file", model.error()));
    const Result<Trajectory> trajectory = trajectory_of(project, key, settings.trajectory, scene);
    if (!trajectory) return fail(trajectory.error());
    scene.intruders.push_back({settings.name, *model, *trajectory});
  }
  return {};
}

}  // namespace

Result<Scene> open_scene(const Project& project, const FootageShape& footage) {
  if (const std::vector<Problem> problems = validate(project); !problems.empty())
    return fail(error_of(project, problems.front()));
  Scene scene{.camera = {.lens = *Lens::make({}), .size_px = footage.size_px},
              .light = {project.light.position_m, project.light.color, project.light.ambient},
              .compositing = project.compositing,
              .footage = footage};
  Result<void> step = set_range(project, footage, scene);
  if (step) step = set_camera(project, footage, scene);
  if (step) step = set_own_body(project, footage, scene);
  if (step) step = set_intruders(project, scene);
  if (!step) return fail(step.error());
  return scene;
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
