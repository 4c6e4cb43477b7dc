// SPDX-License-Identifier: MIT
#include "ego_motion/ego_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sigs {

namespace {

constexpr double kStill_s = 0.5;  // doubled frames of a converted rate are shorter

// Frames of still runs: the camera may have done anything meanwhile.
std::vector<int> still_frames(const EgoMotion& motion) {
  std::vector<int> still;
  for (std::size_t begin = 0; begin < motion.frames.size();) {
    std::size_t end = begin + 1;
    while (end < motion.frames.size() && motion.frames[end].is_repeated) ++end;
    const bool is_all = begin == 0 && end == motion.frames.size();
    if (is_all || motion.frames[end - 1].time_s - motion.frames[begin].time_s > kStill_s)
      for (std::size_t k = begin + 1; k < end; ++k) still.push_back(static_cast<int>(k));
    begin = end;
  }
  return still;
}

bool is_footage_clock(const std::string& clock) {
  return clock.starts_with("footage");
}

}  // namespace

std::string ranges_text(std::span<const int> numbers) {
  constexpr int kShown = 10;
  std::string text;
  int shown = 0;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t j = i;
    while (j + 1 < numbers.size() && numbers[j + 1] == numbers[j] + 1) ++j;
    if (shown++ == kShown) return text + fmt::format(" and {} more", numbers.size() - i);
    if (!text.empty()) text += ", ";
    text += i == j ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[j]);
    i = j + 1;
  }
  return text;
}

void add_low_confidence_frames(EgoMotion& motion, const std::string& where) {
  const std::vector<int> still = still_frames(motion);
  const bool has_gyro = motion.gyro && motion.gyro->is_fused;
  if (!has_gyro)
    for (const int k : still) motion.frames[static_cast<std::size_t>(k)].is_lost = true;
  std::vector<int> lost;
  std::vector<int> cuts;
  bool known = true;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    EgoFrame& frame = motion.frames[k];
    known = known && !frame.is_lost;
    if (!known) frame.sd_rad = glm::dvec3(kUnknownRotation_rad);
    if (frame.is_cut)
      cuts.push_back(static_cast<int>(k));
    else if (frame.is_lost && !frame.is_repeated)
      lost.push_back(static_cast<int>(k));
  }
  const auto warn = [&](const char* what, const std::vector<int>& frames) {
    if (!frames.empty()) motion.warnings.push_back({where, fmt::format("frames {}: {}", ranges_text(frames), what)});
  };
  warn("too few features agree on how the camera turned; its attitude from here on is not known against frame 0", lost);
  warn("nothing of the frame before is seen again (a cut?); attitude from here on is not known against frame 0", cuts);
  warn(has_gyro ? "the image stands still; the gyroscope alone tells how the camera turned"
                : "the image stands still; how the camera turned is not known",
       still);
  if (const int unknown = unknown_frames(motion); unknown > 0)
    motion.warnings.insert(
        motion.warnings.begin(),
        {where, fmt::format("how the camera turned since frame 0 is not known in {} of {} frames, {:.0f} %", unknown,
                            motion.frames.size(), 100.0 * unknown / static_cast<double>(motion.frames.size()))});
}

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
  attitudes.white_cdpm2 = placed(log.white_cdpm2);
  if (log.utc_at_zero_s) attitudes.utc_at_zero_s = *log.utc_at_zero_s + offset_s;
}

}  // namespace sigs
