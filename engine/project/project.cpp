// SPDX-License-Identifier: MIT
#include "project/project.h"

#include <algorithm>

#include "base/pose.h"

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

}  // namespace sigs
