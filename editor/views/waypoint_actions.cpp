// SPDX-License-Identifier: MIT
#include "editor/views/waypoint_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pose.h"
#include "editor/document/project_edits.h"
#include "project/places.h"
#include "scene/scene_at.h"
#include "scene/scene_parts.h"

namespace sigs::editor {

namespace {

TrajectoryPlan& plan_of(Project& project, int intruder) {
  return project.intruders[static_cast<std::size_t>(intruder)].trajectory;
}

const TrajectoryPlan& plan_of(const ViewContext& context, int intruder) {
  return context.project().intruders[static_cast<std::size_t>(intruder)].trajectory;
}

// Ahead of the camera at a frame and to its right, in the world, where it looks.
glm::dvec3 ahead_of_camera(const ViewContext& context, int frame, double forward_m, double right_m) {
  const CameraPose camera = camera_pose_at(context, time_of(context, frame));
  const auto [roll_rad, pitch_rad, yaw_rad] = attitude_of(camera.rotation);
  const glm::dvec3 ahead(std::cos(pitch_rad) * std::cos(yaw_rad), std::cos(pitch_rad) * std::sin(yaw_rad),
                         -std::sin(pitch_rad));
  const glm::dvec3 right(-std::sin(yaw_rad), std::cos(yaw_rad), 0);
  // Centimetres keep the numbers short.
  return glm::round((camera.translation_m + forward_m * ahead + right_m * right) * 100.0) / 100.0;
}

bool is_range_known(const ViewContext& context) {
  const auto& scene = context.shown.scene;
  return context.project().footage.last_frame || (scene && scene->footage && scene->footage->video);
}

}  // namespace

std::optional<int> current_intruder(const ViewContext& context) {
  const Selection& selection = context.document.selection();
  if (context.project().intruders.empty()) return std::nullopt;
  const bool chosen = selection.kind == Selected::intruder || selection.kind == Selected::waypoint;
  return chosen ? selection.intruder : 0;
}

std::optional<int> project_intruder(const ViewContext& context, int in_scene) {
  if (!context.shown.scene) return std::nullopt;
  const std::vector<int>& numbers = context.shown.scene->draft.intruder_of_project;
  for (std::size_t i = 0; i < numbers.size() && i < context.project().intruders.size(); ++i)
    if (numbers[i] == in_scene) return static_cast<int>(i);
  return std::nullopt;
}

std::optional<int> scene_intruder(const ViewContext& context, int in_project) {
  if (!context.shown.scene || in_project < 0) return std::nullopt;
  const std::vector<int>& numbers = context.shown.scene->draft.intruder_of_project;
  const auto index = static_cast<std::size_t>(in_project);
  if (index >= numbers.size() || numbers[index] < 0) return std::nullopt;
  return numbers[index];
}

std::shared_ptr<const Survey> survey_of(const ViewContext& context, int intruder) {
  const auto index = static_cast<std::size_t>(intruder);
  return intruder >= 0 && index < context.shown.surveys.size() ? context.shown.surveys[index] : nullptr;
}

const WaypointSettings* waypoint_of(const Project& project, int intruder, int waypoint) {
  if (intruder < 0 || intruder >= std::ssize(project.intruders)) return nullptr;
  const auto& waypoints = project.intruders[static_cast<std::size_t>(intruder)].trajectory.waypoints;
  return waypoint >= 0 && waypoint < std::ssize(waypoints) ? &waypoints[static_cast<std::size_t>(waypoint)] : nullptr;
}

std::vector<double> frames_of_waypoints(const ViewContext& context, int intruder) {
  return waypoint_frames(plan_of(context, intruder).waypoints, context.document.first_frame(),
                         context.document.last_frame());
}

double frame_of_waypoint(const ViewContext& context, int intruder, int waypoint) {
  return frames_of_waypoints(context, intruder)[static_cast<std::size_t>(waypoint)];
}

bool can_fix_frames(const ViewContext& context, int intruder) {
  const std::vector<WaypointSettings>& waypoints = plan_of(context, intruder).waypoints;
  if (is_range_known(context) || std::ranges::all_of(waypoints, [](const auto& w) { return w.frame.has_value(); }))
    return true;
  context.edits.ask(
      ShowMessage{"Its waypoints are spread evenly over the footage, which is not open. Show where it is "
                  "(File > Find missing files), or give it a last frame, first.",
                  true});
  return false;
}

bool has_headings(const ViewContext& context, int intruder) {
  return plan_of(context, intruder).attitude != AttitudeKind::path;
}

void turn_waypoint(const ViewContext& context, int intruder, int waypoint, std::optional<double> heading_deg,
                   const std::string& gesture) {
  context.edits.change(
      "turn waypoint",
      [=](Project& project) {
        plan_of(project, intruder).waypoints[static_cast<std::size_t>(waypoint)].heading_deg = heading_deg;
      },
      gesture);
}

std::optional<glm::dvec3> position_of(const ViewContext& context, int intruder, double frame) {
  const std::optional<int> in_scene = scene_intruder(context, intruder);
  if (!in_scene) return std::nullopt;
  const SceneIntruder& flown = shown_scene(context)->intruders[static_cast<std::size_t>(*in_scene)];
  return flown.trajectory.position_m(time_of(context, frame));
}

void add_waypoint(const ViewContext& context, int intruder, double frame, const glm::dvec3& position_m) {
  if (!can_fix_frames(context, intruder)) return;
  const std::vector<double> frames = frames_of_waypoints(context, intruder);
  TrajectoryPlan trial = plan_of(context, intruder);
  const int number = put_waypoint(trial, frame, position_m, frames);
  context.edits.change("add waypoint", [=](Project& project) {
    (void)put_waypoint(plan_of(project, intruder), frame, position_m, frames, stated_frame(project.geo));
  });
  context.edits.select({Selected::waypoint, intruder, number});
}

void add_waypoint_here(const ViewContext& context, std::optional<glm::dvec3> position_m) {
  const std::optional<int> intruder = current_intruder(context);
  if (!intruder) return context.edits.ask(ShowMessage{"Add an intruder first: it carries the waypoints.", true});
  const int frame = context.document.playhead();
  if (!position_m) position_m = position_of(context, *intruder, frame);
  if (!position_m) position_m = ahead_of_camera(context, frame, 300, 0);
  add_waypoint(context, *intruder, frame, *position_m);
}

void delete_intruder(const ViewContext& context, int intruder) {
  context.edits.change("delete intruder",
                       [=](Project& project) { project.intruders.erase(project.intruders.begin() + intruder); });
  context.edits.select({});
}

void duplicate_intruder(const ViewContext& context, int intruder) {
  context.edits.change("duplicate intruder", [=](Project& project) {
    IntruderSettings copy = project.intruders[static_cast<std::size_t>(intruder)];
    copy.name += " copy";
    const std::optional<LocalFrame> earth = stated_frame(project.geo);
    for (WaypointSettings& waypoint : copy.trajectory.waypoints)
      put_at(waypoint, waypoint.position_m + glm::dvec3(0, 30, 0), earth);
    project.intruders.insert(project.intruders.begin() + intruder + 1, copy);
  });
  context.edits.select({Selected::intruder, intruder + 1, 0});
}

void delete_selected(const ViewContext& context) {
  const Selection selection = context.document.selection();
  if (selection.kind == Selected::intruder) delete_intruder(context, selection.intruder);
  if (selection.kind != Selected::waypoint) return;
  if (plan_of(context, selection.intruder).waypoints.size() == 1) {
    context.edits.ask(ShowMessage{"An intruder needs one waypoint at least; delete the intruder instead.", true});
    return;
  }
  if (!can_fix_frames(context, selection.intruder)) return;
  context.edits.change("delete waypoint",
                       [=, frames = frames_of_waypoints(context, selection.intruder)](Project& project) {
                         delete_waypoint(plan_of(project, selection.intruder), selection.waypoint, frames);
                       });
}

void duplicate_selected(const ViewContext& context) {
  const Selection selection = context.document.selection();
  if (selection.kind == Selected::intruder) duplicate_intruder(context, selection.intruder);
  if (selection.kind != Selected::waypoint || !can_fix_frames(context, selection.intruder)) return;
  const std::vector<double> frames = frames_of_waypoints(context, selection.intruder);
  TrajectoryPlan trial = plan_of(context, selection.intruder);
  const int copy = duplicate_waypoint(trial, selection.waypoint, frames);
  context.edits.change("duplicate waypoint", [=](Project& project) {
    (void)duplicate_waypoint(plan_of(project, selection.intruder), selection.waypoint, frames,
                             stated_frame(project.geo));
  });
  context.edits.select({Selected::waypoint, selection.intruder, copy});
}

void go_by_hand(const ViewContext& context, int frame) {
  if (context.playing) context.edits.ask(Play{0});
  if (frame != context.document.playhead()) context.edits.go_to_frame(frame);
}

void go_to_moment(const ViewContext& context, double frame) {
  go_by_hand(context, static_cast<int>(std::lround(std::clamp(frame, 0.0, 1e9))));
}

void go_to_waypoint(const ViewContext& context, int direction) {
  const std::optional<int> intruder = current_intruder(context);
  if (!intruder) return;
  const std::vector<double> frames = frames_of_waypoints(context, *intruder);
  const int here = context.document.playhead();
  int found = -1;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const long at = std::lround(frames[static_cast<std::size_t>(i)]);
    if (direction > 0 && at > here && found < 0) found = i;
    if (direction < 0 && at < here) found = i;
  }
  if (found < 0) return;
  go_to_moment(context, frames[static_cast<std::size_t>(found)]);
  context.edits.select({Selected::waypoint, *intruder, found});
}

std::string gesture_of_waypoint(int intruder, int waypoint) {
  return fmt::format("move {} {}", intruder, waypoint);
}

IntruderSettings new_intruder(const ViewContext& context) {
  const Project& now = context.project();
  IntruderSettings intruder;
  if (!now.intruders.empty()) intruder.model = now.intruders.back().model;
  intruder.name = fmt::format("intruder {}", now.intruders.size() + 1);
  const int first = context.document.range_first();
  const int last = std::max(first + 1, context.document.range_last());
  intruder.trajectory.waypoints = {
      {.frame = first, .position_m = ahead_of_camera(context, first, 300, -120)},
      {.frame = last, .position_m = ahead_of_camera(context, last, 300, 120)},
  };
  // Without frames they are at the ends of the footage, wherever these turn out to be.
  if (!is_range_known(context))
    for (WaypointSettings& waypoint : intruder.trajectory.waypoints) waypoint.frame.reset();
  return intruder;
}

void add_intruder(const ViewContext& context) {
  context.edits.change("add intruder",
                       [intruder = new_intruder(context)](Project& project) { project.intruders.push_back(intruder); });
  context.edits.select({Selected::intruder, static_cast<int>(context.project().intruders.size()), 0});
}

}  // namespace sigs::editor
