// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ego_motion/ego_motion.h"

namespace sigs {

int unknown_frames(const EgoMotion& motion) {
  return static_cast<int>(std::count_if(motion.frames.begin(), motion.frames.end(), [](const EgoFrame& frame) {
    return frame.is_lost || std::max({frame.sd_rad.x, frame.sd_rad.y, frame.sd_rad.z}) > kUnknownRotation_rad / 2;
  }));
}

Result<void> check_known(const EgoMotion& motion, const std::string& where, double max_unknown_share) {
  const int unknown = unknown_frames(motion);
  const auto frames = static_cast<int>(motion.frames.size());
  if (unknown <= max_unknown_share * frames) return {};
  return fail(where, fmt::format("how the camera turned is not known in {} of {} frames, more than {:g} %: the images "
                                 "show too little that stays in place, such as sky alone; use a part of the footage or "
                                 "a log with angular rates",
                                 unknown, frames, 100 * max_unknown_share));
}

Track track_of(const EgoMotion& motion, const std::filesystem::path& footage) {
  Track track{.file = footage,
              .format = "images",
              .on_footage_time = true,
              .heading_is_north = false,
              .attitude_is_whole = true};
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
  track.level_is_known = motion.level_sd_rad.has_value();
  track.warnings = motion.warnings;
  return track;
}

namespace {

bool is_footage_clock(const std::string& clock) {
  return clock.starts_with("footage");
}

}  // namespace

void add_log(Track& attitudes, const Track& log, const EgoMotion& motion) {
  attitudes.readout_s = log.readout_s;
  const bool is_placed = motion.gyro && motion.gyro->is_fused;
  if (!is_placed && !log.on_footage_time) return;
  // Positions change slowly: the drift of the clock does not show in them.
  const double offset_s = is_placed ? motion.gyro->offset_s : 0;
  const auto placed = [&](auto channel) {
    // What has a clock of its own and is placed on the footage already, the gyroscope does not place.
    const bool has_own_clock =
        log.on_footage_time && is_footage_clock(channel.clock) != is_footage_clock(log.camera_rate_radps.clock);
    for (double& time_s : channel.times_s) time_s -= has_own_clock ? 0 : offset_s;
    return channel;
  };
  attitudes.position = placed(log.position);
  attitudes.height_above_ellipsoid = log.height_above_ellipsoid;
  attitudes.local_position_ned_m = placed(log.local_position_ned_m);
  attitudes.velocity_ned_mps = placed(log.velocity_ned_mps);
  attitudes.exposure_s = placed(log.exposure_s);
  if (log.utc_at_zero_s) attitudes.utc_at_zero_s = *log.utc_at_zero_s + offset_s;
}

}  // namespace sigs
