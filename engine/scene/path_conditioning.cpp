// SPDX-License-Identifier: MIT
#include "scene/path_conditioning.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "scene/scene_parts.h"
#include "scene/waypoint_times.h"
#include "spline/conditioning.h"

namespace sigs {

namespace {

// Nothing where the times do not shape the path.
std::vector<TimedWaypoint> shaping_waypoints(const TrajectoryPlan& plan, const Scene& scene) {
  if (plan.spline != SplineChoice::interpolating) return {};
  return timed_waypoints(plan.waypoints, scene.footage, scene.first_frame, scene.last_frame);
}

// The first of equals.
const Overshoot& farthest(const std::vector<Overshoot>& overshoots) {
  return *std::max_element(overshoots.begin(), overshoots.end(),
                           [](const Overshoot& a, const Overshoot& b) { return a.overshoot_m < b.overshoot_m; });
}

std::string text_of(const Overshoot& worst, std::size_t others, const std::string& name,
                    const std::vector<double>& frames) {
  std::ostringstream text;  // with six digits
  text << '"' << name << "\" overshoots " << worst.overshoot_m
       << " m off the straight way between its waypoints of frames " << std::setprecision(10) << frames[worst.leg]
       << " and " << frames[worst.leg + 1] << std::setprecision(6) << ", where no leg is longer than "
       << worst.max_leg_m << " m";
  if (others > 0) text << " (and in " << others << (others == 1 ? " other leg)" : " other legs)");
  text << ": the frames do not go with the distances; leave them out to spread them evenly, add waypoints in between,"
       << " or set trajectory.spline to approximating";
  return text.str();
}

}  // namespace

std::optional<double> path_condition(const Project& project, std::size_t intruder, const Scene& scene) {
  const std::vector<TimedWaypoint> waypoints = shaping_waypoints(project.intruders[intruder].trajectory, scene);
  if (waypoints.empty()) return std::nullopt;
  return interpolation_condition(waypoints);
}

std::optional<Problem> overshoot_issue(const Project& project, std::size_t intruder, const Scene& scene) {
  const IntruderSettings& settings = project.intruders[intruder];
  const std::vector<TimedWaypoint> waypoints = shaping_waypoints(settings.trajectory, scene);
  if (waypoints.empty()) return std::nullopt;
  const std::vector<Overshoot> overshoots = overshoots_of(waypoints);
  if (overshoots.empty()) return std::nullopt;
  const std::vector<double> frames =
      waypoint_frames(settings.trajectory.waypoints, scene.first_frame, scene.last_frame);
  return Problem{key_of_intruder(intruder) + ".trajectory",
                 text_of(farthest(overshoots), overshoots.size() - 1, settings.name, frames)};
}

}  // namespace sigs
