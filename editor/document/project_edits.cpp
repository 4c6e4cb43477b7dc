// SPDX-License-Identifier: MIT
#include "editor/document/project_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/ensure.h"
#include "base/paths.h"
#include "editor/document/project_paths.h"

namespace sigs::editor {

namespace {

// Each waypoint with the frame at which it stands.
void fix_frames(TrajectoryPlan& plan, const std::vector<double>& frames_now) {
  ENSURE(frames_now.size() == plan.waypoints.size());
  for (std::size_t i = 0; i < frames_now.size(); ++i) plan.waypoints[i].frame = frames_now[i];
}

bool is_waypoint(const TrajectoryPlan& plan, int waypoint) {
  return waypoint >= 0 && static_cast<std::size_t>(waypoint) < plan.waypoints.size();
}

WaypointSettings new_waypoint(const TrajectoryPlan& plan, double frame, const glm::dvec3& position_m,
                              const std::optional<LocalFrame>& earth) {
  WaypointSettings waypoint{.frame = frame};
  const bool among_places =
      !plan.waypoints.empty() &&
      std::ranges::all_of(plan.waypoints, [](const WaypointSettings& other) { return other.place.has_value(); });
  if (among_places) waypoint.place.emplace();
  put_at(waypoint, position_m, earth);
  return waypoint;
}

std::string new_name(const Project& whole, const std::filesystem::path& video) {
  std::string name = video.stem().string();
  if (name.empty() || !file_name_error(name).empty()) name = fmt::format("camera {}", whole.cameras.size() + 1);
  const std::string stem = name;
  const auto is_taken = [&] { return std::ranges::find(whole.cameras, name, &RigCamera::name) != whole.cameras.end(); };
  for (int number = 2; is_taken(); ++number) name = fmt::format("{} {}", stem, number);
  return name;
}

}  // namespace

void put_at(WaypointSettings& waypoint, const glm::dvec3& position_m, const std::optional<LocalFrame>& earth) {
  waypoint.position_m = position_m;
  if (!waypoint.place) return;
  waypoint.place.reset();
  if (!earth) return;
  const GeodeticPosition place = earth->place_of(position_m);
  waypoint.place = {place.latitude_deg, place.longitude_deg, place.height_m};
}

int put_waypoint(TrajectoryPlan& plan, double frame, const glm::dvec3& position_m,
                 const std::vector<double>& frames_now, const std::optional<LocalFrame>& earth) {
  fix_frames(plan, frames_now);
  const auto after = std::ranges::find_if(plan.waypoints,
                                          [&](const WaypointSettings& w) { return *w.frame > frame - kMinGap_frames; });
  const auto number = static_cast<int>(after - plan.waypoints.begin());
  if (after != plan.waypoints.end() && *after->frame < frame + kMinGap_frames)
    put_at(*after, position_m, earth);
  else
    plan.waypoints.insert(after, new_waypoint(plan, frame, position_m, earth));
  return number;
}

void delete_waypoint(TrajectoryPlan& plan, int waypoint, const std::vector<double>& frames_now) {
  if (!is_waypoint(plan, waypoint) || plan.waypoints.size() == 1) return;
  fix_frames(plan, frames_now);
  plan.waypoints.erase(plan.waypoints.begin() + waypoint);
}

int duplicate_waypoint(TrajectoryPlan& plan, int waypoint, const std::vector<double>& frames_now,
                       const std::optional<LocalFrame>& earth) {
  if (!is_waypoint(plan, waypoint)) return waypoint;
  fix_frames(plan, frames_now);
  const auto index = static_cast<std::size_t>(waypoint);
  const WaypointSettings& original = plan.waypoints[index];
  WaypointSettings copy = original;
  if (index + 1 < plan.waypoints.size()) {
    const WaypointSettings& next = plan.waypoints[index + 1];
    if (*next.frame - *original.frame < 2 * kMinGap_frames) return waypoint;
    copy.frame = std::midpoint(*original.frame, *next.frame);
    put_at(copy, (original.position_m + next.position_m) * 0.5, earth);
  } else {
    const bool alone = index == 0;
    const double gap = alone ? 25 : *original.frame - *plan.waypoints[index - 1].frame;
    copy.frame = *original.frame + std::max(kMinGap_frames, gap);
    const glm::dvec3 step_m = alone ? glm::dvec3(50, 0, 0) : original.position_m - plan.waypoints[index - 1].position_m;
    put_at(copy, original.position_m + step_m, earth);
  }
  plan.waypoints.insert(plan.waypoints.begin() + waypoint + 1, copy);
  return waypoint + 1;
}

void move_waypoint_in_time(TrajectoryPlan& plan, int waypoint, double frame, const std::vector<double>& frames_now) {
  if (!is_waypoint(plan, waypoint) || !std::isfinite(frame)) return;
  fix_frames(plan, frames_now);
  const auto index = static_cast<std::size_t>(waypoint);
  const double lowest = index > 0 ? *plan.waypoints[index - 1].frame + kMinGap_frames : -1e9;
  const double highest = index + 1 < plan.waypoints.size() ? *plan.waypoints[index + 1].frame - kMinGap_frames : 1e9;
  if (lowest <= highest) plan.waypoints[index].frame = std::clamp(frame, lowest, highest);
}

void add_camera(Project& whole, const std::filesystem::path& video) {
  if (whole.cameras.empty()) {
    whole.cameras.emplace_back().name = "camera 1";
    whole.cameras.front().footage = std::exchange(whole.footage, {});
  }
  RigCamera added;
  added.name = new_name(whole, video);
  added.footage.video = path_in_project(whole, video);
  whole.cameras.push_back(std::move(added));
}

void remove_camera(Project& whole, std::size_t camera) {
  if (camera == 0 || camera >= whole.cameras.size()) return;
  whole.cameras.erase(whole.cameras.begin() + static_cast<std::ptrdiff_t>(camera));
  if (whole.cameras.size() > 1 || whole.cameras.front().mount != MountSettings()) return;
  RigCamera& left = whole.cameras.front();
  whole.footage = std::move(left.footage);
  if (left.readout_s) whole.camera.readout_s = left.readout_s;
  if (left.exposure_s) whole.camera.exposure_s = left.exposure_s;
  if (left.appearance) whole.appearance = *left.appearance;
  whole.cameras.clear();
}

std::string why_not_called(const Project& whole, std::size_t camera, const std::string& name) {
  if (name.empty()) return "A camera needs a name.";
  if (const std::string wrong = file_name_error(name); !wrong.empty()) return "The name " + wrong + ".";
  for (std::size_t i = 0; i < whole.cameras.size(); ++i)
    if (i != camera && whole.cameras[i].name == name) return "Another camera is called so.";
  return "";
}

}  // namespace sigs::editor
