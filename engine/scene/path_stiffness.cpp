// SPDX-License-Identifier: MIT
#include "scene/path_stiffness.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "scene/scene_parts.h"
#include "scene/waypoint_times.h"
#include "spline/stiffness.h"

namespace sigs {

namespace {

// Nothing where the times do not shape the path.
std::vector<TimedWaypoint> shaping_waypoints(const TrajectoryPlan& plan, const Scene& scene) {
  if (plan.spline != SplineChoice::interpolating) return {};
  return timed_waypoints(plan.waypoints, scene.footage, scene.first_frame, scene.last_frame);
}

// The first of equals.
const Swing& farthest(const std::vector<Swing>& swings) {
  return *std::max_element(swings.begin(), swings.end(),
                           [](const Swing& a, const Swing& b) { return a.swing_m < b.swing_m; });
}

std::string text_of(const Swing& worst, std::size_t others, const std::string& name,
                    const std::vector<double>& frames) {
  std::ostringstream text;  // with six digits
  text << '"' << name << "\" swings " << worst.swing_m << " m off the straight way between its waypoints of frames "
       << std::setprecision(10) << frames[worst.leg] << " and " << frames[worst.leg + 1] << std::setprecision(6)
       << ", where no leg is longer than " << worst.longest_m << " m";
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

std::optional<Problem> swing_doubt(const Project& project, std::size_t intruder, const Scene& scene) {
  const IntruderSettings& settings = project.intruders[intruder];
  const std::vector<TimedWaypoint> waypoints = shaping_waypoints(settings.trajectory, scene);
  if (waypoints.empty()) return std::nullopt;
  const std::vector<Swing> swings = swings_of(waypoints);
  if (swings.empty()) return std::nullopt;
  const std::vector<double> frames =
      waypoint_frames(settings.trajectory.waypoints, scene.first_frame, scene.last_frame);
  return Problem{key_of_intruder(intruder) + ".trajectory",
                 text_of(farthest(swings), swings.size() - 1, settings.name, frames)};
}

}  // namespace sigs
