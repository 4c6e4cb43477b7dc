// SPDX-License-Identifier: MIT
#include "scene/waypoint_times.h"

#include <optional>

namespace sigs {

std::vector<double> waypoint_frames(const std::vector<WaypointSettings>& waypoints, int first_frame, int last_frame) {
  if (waypoints.empty()) return {};
  std::vector<std::optional<double>> frames;
  for (const WaypointSettings& waypoint : waypoints) frames.push_back(waypoint.frame);
  if (!frames.front()) frames.front() = first_frame;
  if (!frames.back()) frames.back() = last_frame;

  std::vector<double> spread(frames.size(), *frames.front());
  std::size_t known = 0;  // the last waypoint that carries a frame
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (!frames[i]) continue;
    const double step = (*frames[i] - *frames[known]) / static_cast<double>(i - known);
    for (std::size_t j = known + 1; j < i; ++j) spread[j] = *frames[known] + step * static_cast<double>(j - known);
    spread[i] = *frames[i];
    known = i;
  }
  return spread;
}

std::vector<TimedWaypoint> timed_waypoints(const std::vector<WaypointSettings>& waypoints, const FootageShape& footage,
                                           int first_frame, int last_frame) {
  const std::vector<double> frames = waypoint_frames(waypoints, first_frame, last_frame);
  std::vector<TimedWaypoint> timed;
  for (std::size_t i = 0; i < frames.size(); ++i)
    timed.push_back({time_of_frame_s(footage, frames[i]), waypoints[i].position_m});
  return timed;
}

}  // namespace sigs
