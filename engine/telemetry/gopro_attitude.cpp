// SPDX-License-Identifier: MIT
#include "telemetry/gopro_attitude.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "telemetry/log_samples.h"

namespace sigs {
namespace {

constexpr double kApart_rad = rad_of_deg(5);

// Between two samples at an even rate; before the first and after the last as these.
glm::dquat turn_at(const Channel<glm::dquat>& channel, double time_s) {
  const auto after = std::upper_bound(channel.times_s.begin(), channel.times_s.end(), time_s);
  const std::size_t i = static_cast<std::size_t>(after - channel.times_s.begin());
  if (i == 0) return channel.values.front();
  if (i == channel.times_s.size()) return channel.values.back();
  const double share = (time_s - channel.times_s[i - 1]) / (channel.times_s[i] - channel.times_s[i - 1]);
  return glm::slerp(channel.values[i - 1], channel.values[i], share);
}

// The smallest turn that takes a direction to Z.
glm::dquat turn_to_down(const glm::dvec3& direction) {
  const glm::dvec3 down(0, 0, 1);
  const double along = glm::dot(direction, down);
  if (along < -1 + 1e-12) return {0, 1, 0, 0};
  return glm::normalize(glm::dquat(1 + along, glm::cross(direction, down)));
}

std::optional<glm::dvec3> down_at_start(Track& track) {
  const Channel<glm::dvec3>& gravity = track.camera_gravity;
  if (gravity.empty()) return std::nullopt;
  glm::dvec3 sum(0);
  std::vector<glm::dvec3> all;
  for (std::size_t i = 0; i < gravity.values.size(); ++i) {
    all.push_back(turn_at(track.start_from_camera, gravity.times_s[i]) * gravity.values[i]);
    sum += all.back();
  }
  std::vector<double> apart_rad;
  for (const glm::dvec3& down : all) apart_rad.push_back(angle_between(down, sum));
  const double median_rad = median_of(apart_rad);
  if (median_rad <= kApart_rad) return glm::normalize(sum);
  track.warnings.push_back(
      {track.file.string() + ": GRAV",
       fmt::format("does not turn with CORI: by {:.1f} degrees in the median; where level is, is not known",
                   deg_of_rad(median_rad))});
  return std::nullopt;
}

}  // namespace

void join_camera_attitude(Track& track) {
  if (track.start_from_camera.empty() || !track.ned_from_airframe.empty()) return;
  const Channel<glm::dquat>& image = track.camera_from_image;
  Channel<glm::dquat>& joined = track.ned_from_camera;
  joined = track.start_from_camera;
  if (!image.empty()) joined.source += " * IORI";
  for (std::size_t i = 0; i < joined.values.size() && !image.empty(); ++i)
    joined.values[i] = glm::normalize(joined.values[i] * turn_at(image, joined.times_s[i]));
  const std::optional<glm::dvec3> down = down_at_start(track);
  const glm::dquat first = joined.values.front();
  const glm::dquat level = down ? turn_to_down(*down) : glm::conjugate(first);
  const glm::dquat heading = rotation_of({0, 0, down ? -attitude_of(level * first).yaw_rad : 0});
  for (glm::dquat& value : joined.values) value = glm::normalize(heading * level * value);
  track.heading_is_north = false;
  track.level_is_known = down.has_value();
  track.attitude_is_whole = true;
}

}  // namespace sigs
