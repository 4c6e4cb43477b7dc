// SPDX-License-Identifier: MIT
#include "project/project.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.h"

namespace sigs {

std::vector<std::string> categories_of(const Project& project) {
  if (!project.output.categories.empty()) return project.output.categories;
  std::vector<std::string> categories;
  for (const IntruderSettings& intruder : project.intruders)
    if (std::find(categories.begin(), categories.end(), intruder.category) == categories.end())
      categories.push_back(intruder.category);
  return categories;
}

LampSettings usual_lights(const std::string& category) {
  if (category == "drone") return {.position_cd = 2, .strobe_cd = 25, .flash_s = 0.1};
  if (category == "helicopter") return {.position_cd = 40, .strobe_cd = 200, .beacon_cd = 150, .flash_s = 0.05};
  return {.position_cd = 60, .strobe_cd = 400, .beacon_cd = 150, .flashes_per_minute = 55};
}

AttitudeKind attitude_of_category(const std::string& category) {
  if (category == "helicopter") return AttitudeKind::helicopter;
  if (category == "drone") return AttitudeKind::multirotor;
  return category == "balloon" ? AttitudeKind::balloon : AttitudeKind::path;
}

Attitude mount_attitude(const CameraSettings& camera) {
  return {rad_of_deg(camera.roll_deg.value_or(0)), rad_of_deg(camera.pitch_deg.value_or(0)),
          rad_of_deg(camera.yaw_deg)};
}

bool knows_horizon(const CameraSettings& camera) {
  return camera.roll_deg || camera.pitch_deg || !camera.attitude_file.empty();
}

std::filesystem::path resolved(const Project& project, const std::string& path) {
  return path.empty() ? std::filesystem::path() : project.file.parent_path() / path;
}

Project seen_by(const Project& project, std::size_t camera) {
  const RigCamera& one = project.cameras.at(camera);
  Project seen = project;
  seen.cameras.clear();
  seen.rig_view = RigView{.camera = camera,
                          .name = one.name,
                          .mount = one.mount,
                          .clock = one.clock,
                          .reference = project.cameras.front().footage,
                          .reference_mount = project.cameras.front().mount,
                          .has_own_appearance = one.appearance.has_value()};
  seen.name = project.name + "." + one.name;
  seen.footage = one.footage;
  if (one.readout_s) seen.camera.readout_s = one.readout_s;
  if (one.exposure_s) seen.camera.exposure_s = one.exposure_s;
  if (one.appearance) seen.appearance = *one.appearance;
  return seen;
}

Project put_back(const Project& whole, Project seen) {
  if (!seen.rig_view) return seen;
  const RigView view = *std::exchange(seen.rig_view, std::nullopt);
  const Project before = seen_by(whole, view.camera);
  seen.cameras = whole.cameras;
  RigCamera& camera = seen.cameras[view.camera];
  camera.footage = std::exchange(seen.footage, whole.footage);
  camera.mount = view.mount;
  camera.clock = view.clock;
  if (camera.appearance || seen.appearance != before.appearance) camera.appearance = seen.appearance;
  seen.appearance = whole.appearance;
  const auto own = [](std::optional<double>& of_camera, std::optional<double>& of_rig, std::optional<double> rig) {
    if (of_camera) of_camera = std::exchange(of_rig, rig);
  };
  own(camera.readout_s, seen.camera.readout_s, whole.camera.readout_s);
  own(camera.exposure_s, seen.camera.exposure_s, whole.camera.exposure_s);
  const std::string suffix = "." + view.name;
  if (seen.name.ends_with(suffix)) seen.name.resize(seen.name.size() - suffix.size());
  return seen;
}

std::vector<Project> seen_by_each(const Project& project) {
  if (project.cameras.empty()) return {project};
  std::vector<Project> seen;
  for (std::size_t i = 0; i < project.cameras.size(); ++i) seen.push_back(seen_by(project, i));
  return seen;
}

Result<std::size_t> camera_named(const Project& project, const std::string& name) {
  std::vector<std::string_view> names;
  for (const RigCamera& camera : project.cameras) names.emplace_back(camera.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  return fail("camera " + name,
              names.empty() ? project.file.string() + " has one camera, which has no name"
                            : fmt::format("{} has no such camera; it has {}", project.file.string(), listed(names)),
              ErrorKind::usage);
}

std::string field_in_file(const Project& project, const std::string& field) {
  if (!project.rig_view) return field;
  const bool is_of_camera = field.starts_with("footage.") ||
                            (field.starts_with("appearance.") && project.rig_view->has_own_appearance) ||
                            field.starts_with("mount.") || field.starts_with("clock.");
  return is_of_camera ? fmt::format("cameras[{}].{}", project.rig_view->camera, field) : field;
}

Pose<frame::Body, frame::Camera> body_from_camera(const MountSettings& mount) {
  return {rotation_of({rad_of_deg(mount.roll_deg), rad_of_deg(mount.pitch_deg), rad_of_deg(mount.yaw_deg)}),
          mount.position_m};
}

}  // namespace sigs
