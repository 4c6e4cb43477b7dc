// SPDX-License-Identifier: MIT
#include <cmath>

#include "ego_motion/ego_motion.h"

namespace sigs {

Track track_of(const EgoMotion& motion, const std::filesystem::path& footage) {
  Track track{.file = footage, .format = "images", .on_footage_time = true, .heading_is_north = false};
  track.ned_from_camera.source = "ego-motion";
  track.ned_from_camera.clock = "footage";
  track.camera_attitude_sd_rad.source = "ego-motion";
  track.camera_attitude_sd_rad.clock = "footage";
  // The level's uncertainty is about the world's X and Y; about each of the camera's axes no more.
  const double level = motion.level_sd_rad.value_or(0);
  for (const EgoFrame& frame : motion.frames) {
    if (frame.is_lost) continue;
    const glm::dvec3 down = glm::conjugate(frame.world_from_camera) * glm::dvec3(0, 0, 1);
    glm::dvec3 sd_rad;
    for (int axis = 0; axis < 3; ++axis)
      sd_rad[axis] = std::hypot(frame.sd_rad[axis], level * std::sqrt(std::max(0.0, 1 - down[axis] * down[axis])));
    track.ned_from_camera.times_s.push_back(frame.time_s);
    track.ned_from_camera.values.push_back(frame.world_from_camera);
    track.camera_attitude_sd_rad.times_s.push_back(frame.time_s);
    track.camera_attitude_sd_rad.values.push_back(sd_rad);
  }
  track.warnings = motion.warnings;
  return track;
}

}  // namespace sigs
