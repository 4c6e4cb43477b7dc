// SPDX-License-Identifier: MIT
#include "scene/draft.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "base/ensure.h"
#include "project/fields.h"
#include "scene/camera_track.h"
#include "scene/plausibility.h"
#include "scene/scene_light.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace {

constexpr double kCrossLength_m = 10;
constexpr int kPlaceholderWidth_px = 1280;
constexpr int kPlaceholderHeight_px = 960;
constexpr double kPlaceholderInterval_s = 1.0 / 25;
constexpr int kMinPlaceholderFrames = 250;
constexpr int kMaxPlaceholderFrames = 100'000;

// "intruders[1]" contains "intruders[1].model.file", but not "intruders[12]".
bool contains(std::string_view outer, std::string_view inner) {
  return inner.starts_with(outer) &&
         (inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[');
}

// Opening often finds again what validating has found, in the same field or in a part of it.
bool is_known(const std::vector<Problem>& problems, const Problem& found) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& known) {
    return contains(known.field, found.field) || contains(found.field, known.field);
  });
}

void note(std::vector<Problem>& problems, const Problem& found) {
  if (!is_known(problems, found)) problems.push_back(found);
}

// Of several problems in one field only the first.
std::vector<Problem> validated(const Project& project) {
  std::vector<Problem> problems;
  for (Problem& found : validate(project)) {
    const auto is_same = [&](const Problem& known) { return known.field == found.field; };
    if (std::none_of(problems.begin(), problems.end(), is_same)) problems.push_back(std::move(found));
  }
  return problems;
}

template <class T>
T part_or_placeholder(Result<T, Problem> part, T placeholder, std::vector<Problem>& problems) {
  if (part) return *std::move(part);
  note(problems, part.error());
  return placeholder;
}

FrameRange clamped_range(const FootageSettings& settings, const FootageShape& footage) {
  const int last = static_cast<int>(footage.times_s.size()) - 1;
  const int first = std::clamp(settings.first_frame, 0, last);
  return {first, std::clamp(settings.last_frame.value_or(last), first, last)};
}

bool is_finite(const WaypointSettings& waypoint) {
  const glm::dvec3& p = waypoint.position_m;
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
         (!waypoint.frame || std::isfinite(*waypoint.frame));
}

// By the project as written: `clean` has a default in place of a number that is not finite, and a trajectory through
// that default is not meant.
bool can_be_flown(const Project& written, std::size_t intruder) {
  const std::vector<WaypointSettings>& waypoints = written.intruders[intruder].trajectory.waypoints;
  return std::all_of(waypoints.begin(), waypoints.end(), is_finite);
}

Trajectory hovering(const Project& clean, std::size_t intruder) {
  const TrajectoryPlan& plan = clean.intruders[intruder].trajectory;
  const std::vector<TimedWaypoint> there = {{0, plan.waypoints.front().position_m}};
  return *Trajectory::make(there, trajectory_settings(plan, there));
}

Trajectory drafted_trajectory(const Project& written, const Project& clean, std::size_t intruder, DraftScene& draft) {
  if (!can_be_flown(written, intruder)) return hovering(clean, intruder);
  Result<Trajectory, Problem> trajectory = scene_trajectory(clean, intruder, draft.scene);
  return part_or_placeholder(std::move(trajectory), hovering(clean, intruder), draft.problems);
}

std::shared_ptr<const Model> drafted_model(const Project& clean, std::size_t intruder, DraftScene& draft,
                                           SceneFiles& files) {
  Result<std::shared_ptr<const Model>, Problem> model = scene_model(clean, intruder, files);
  if (model) return *model;
  note(draft.problems, model.error());
  if (!clean.intruders[intruder].model.rotors.empty()) {  // the rest of it may be right
    Project without = clean;
    without.intruders[intruder].model.rotors.clear();
    if (const auto rest = scene_model(without, intruder, files)) return *rest;
  }
  const double length_m = clean.intruders[intruder].model.length_m;
  return files.cross(length_m > 0 ? length_m : kCrossLength_m);
}

void sanitize(const Field& field, double& number, double plain) {
  number = std::isfinite(number) ? std::clamp(number, field.minimum, field.maximum) : plain;
}

void sanitize(const Field& field, int& number) {
  // Compared as doubles: a field's ends need not be whole numbers that an int holds.
  if (number < field.minimum) number = static_cast<int>(field.minimum);
  if (number > field.maximum) number = static_cast<int>(field.maximum);
}

// plain: the same field of a project with defaults.
void sanitize(const Field& field, const Field& plain) {
  if (auto* const number = std::get_if<double*>(&field.value))
    sanitize(field, **number, *std::get<double*>(plain.value));
  if (auto* const number = std::get_if<int*>(&field.value)) sanitize(field, **number);
  if (auto* const number = std::get_if<std::optional<int>*>(&field.value); number && **number)
    sanitize(field, ***number);
  if (auto* const number = std::get_if<std::optional<double>*>(&field.value); number && **number) {
    if (std::isfinite(***number)) {
      sanitize(field, ***number, 0);
    } else {
      **number = std::nullopt;
    }
  }
  if (auto* const vector = std::get_if<glm::dvec3*>(&field.value))
    for (int i = 0; i < 3; ++i) sanitize(field, (**vector)[i], (*std::get<glm::dvec3*>(plain.value))[i]);
}

// Waypoints count the same frames in all cameras of a rig, also where the first one's cannot be opened.
Timeline drafted_timeline(const Project& clean, SceneFiles& files) {
  if (const Result<std::optional<Timeline>, Problem> known = scene_timeline(clean, files); known && *known)
    return **known;
  Project first = clean;
  first.footage = clean.rig_view->reference;
  FootageShape footage = placeholder_footage(first);
  const FrameRange range = clamped_range(first.footage, footage);
  return {std::move(footage), range.first, range.last};
}

Camera placeholder_camera(cv::Size size_px) {
  const double focal_px = 0.5 * size_px.width / std::tan(std::numbers::pi / 6);
  return {
      *Lens::make({.fx = focal_px, .fy = focal_px, .cx = (size_px.width - 1) / 2.0, .cy = (size_px.height - 1) / 2.0}),
      size_px};
}

}  // namespace

Project sanitized(Project project) {
  Project plain = default_project_like(project);
  const std::vector<Field> fields = fields_of(project);
  const std::vector<Field> plain_fields = fields_of(plain);
  ENSURE(fields.size() == plain_fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) sanitize(fields[i], plain_fields[i]);
  return project;
}

DraftScene draft_scene(const Project& project, const FootageShape& footage, SceneFiles& files) {
  ENSURE(!footage.times_s.empty() && !footage.size_px.empty());
  const Project clean = sanitized(project);
  DraftScene draft{.scene = bare_scene(clean, footage), .problems = validated(project)};
  Scene& scene = draft.scene;
  const FrameRange clamped = clamped_range(clean.footage, footage);
  scene.first_frame = clamped.first;
  scene.last_frame = clamped.last;
  if (const Result<void, Problem> timed = set_range(scene, clean, files); !timed) note(draft.problems, timed.error());
  if (clean.rig_view && clean.rig_view->camera > 0 && !scene.timeline) scene.timeline = drafted_timeline(clean, files);
  const FrameRange range{scene.first_frame, scene.last_frame};
  scene.camera =
      part_or_placeholder(scene_camera(clean, footage, files), placeholder_camera(footage.size_px), draft.problems);
  set_camera_motion(
      scene, part_or_placeholder(camera_flight(clean, footage, range, files), steady_flight(clean), draft.problems));
  while (const std::optional<Problem> problem = panorama_problem(scene)) {
    draft.problems.push_back(*problem);
    if (problem->field == "camera.readout_s") scene.motion.readout_s = 0;
    scene.compositing.method = MethodChoice::direct;
  }
  scene.light = part_or_placeholder(scene_light(clean, scene), placeholder_light(scene.light), draft.problems);
  scene.own_body = part_or_placeholder(scene_own_body(clean, footage.size_px, files), cv::Mat(), draft.problems);
  scene.real_aircraft = part_or_placeholder(scene_real_aircraft(clean, files), BoxesByFrame(), draft.problems);
  scene.occluder = part_or_placeholder(scene_occluder(clean, scene, files), Occluder(), draft.problems);
  for (std::size_t i = 0; i < clean.intruders.size(); ++i) {
    const bool has_waypoint = !clean.intruders[i].trajectory.waypoints.empty();
    draft.intruder_of_project.push_back(has_waypoint ? static_cast<int>(scene.intruders.size()) : -1);
    const std::shared_ptr<const Model> model = drafted_model(clean, i, draft, files);
    if (!has_waypoint) continue;
    add_intruder(scene, clean.intruders[i].name, model, drafted_trajectory(project, clean, i, draft));
    scene.intruders.back().is_distractor = clean.intruders[i].role == RoleChoice::distractor;
    scene.intruders.back().contrail = clean.intruders[i].contrail;
    scene.intruders.back().lights = clean.intruders[i].lights;
  }
  scene.issues = plausibility_issues(clean, scene, draft.intruder_of_project);
  // A field with a problem is not reported as implausible too.
  std::erase_if(scene.issues, [&](const Problem& issue) { return is_known(draft.problems, issue); });
  return draft;
}

FootageShape placeholder_footage(const Project& project) {
  const Project clean = sanitized(project);
  double last = std::max(clean.footage.first_frame, clean.footage.last_frame.value_or(0));
  for (const IntruderSettings& intruder : clean.intruders)
    for (const WaypointSettings& waypoint : intruder.trajectory.waypoints)
      last = std::max(last, std::ceil(waypoint.frame.value_or(0)));
  const int count = static_cast<int>(std::clamp<double>(last + 1, kMinPlaceholderFrames, kMaxPlaceholderFrames));
  // With another size than the calibration's, a second problem would be reported.
  const Result<Camera> camera =
      read_calibration(resolved(clean, clean.footage.calibration), {}, clean.footage.lens_model);
  FootageShape footage{.size_px = camera ? camera->size_px : cv::Size(kPlaceholderWidth_px, kPlaceholderHeight_px),
                       .frame_interval_s = kPlaceholderInterval_s};
  for (int frame = 0; frame < count; ++frame) footage.times_s.push_back(frame * kPlaceholderInterval_s);
  return footage;
}

}  // namespace sigs
