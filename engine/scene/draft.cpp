// SPDX-License-Identifier: MIT
#include "scene/draft.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/ensure.h"
#include "scene/placeholders.h"
#include "scene/plausibility.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace {

constexpr double kCrossLength_m = 10;
constexpr int kPlaceholderWidth_px = 1280;
constexpr int kPlaceholderHeight_px = 960;
constexpr double kPlaceholderInterval_s = 1.0 / 25;
constexpr int kMinFrames = 250;
constexpr int kMaxFrames = 100'000;

// "intruders[1]" holds "intruders[1].model.file", but not "intruders[12]".
bool holds(std::string_view outer, std::string_view inner) {
  return inner.starts_with(outer) &&
         (inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[');
}

// What opening finds is often what checking has named: of the same field, or of a part of it.
bool is_known(const std::vector<Problem>& problems, const Problem& found) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& known) {
    return holds(known.field, found.field) || holds(found.field, known.field);
  });
}

void note(std::vector<Problem>& problems, const Problem& found) {
  if (!is_known(problems, found)) problems.push_back(found);
}

// Of several in one field, the first.
std::vector<Problem> checked(const Project& project) {
  std::vector<Problem> problems;
  for (Problem& found : validate(project)) {
    const auto is_same = [&](const Problem& known) { return known.field == found.field; };
    if (std::none_of(problems.begin(), problems.end(), is_same)) problems.push_back(std::move(found));
  }
  return problems;
}

template <class T>
T made_or_fallback(OrProblem<T> made, T placeholder, std::vector<Problem>& problems) {
  if (made) return *std::move(made);
  note(problems, made.error());
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

// As written: a number that is none was sanitized in `clean`, but nobody wants to fly through its default.
bool can_be_flown(const Project& written, std::size_t intruder) {
  const std::vector<WaypointSettings>& waypoints = written.intruders[intruder].trajectory.waypoints;
  return std::all_of(waypoints.begin(), waypoints.end(), is_finite);
}

Trajectory hovering(const Project& clean, std::size_t intruder) {
  const TrajectoryPlan& plan = clean.intruders[intruder].trajectory;
  return *Trajectory::make({{0, plan.waypoints.front().position_m}}, trajectory_settings(plan));
}

Trajectory drafted_trajectory(const Project& written, const Project& clean, std::size_t intruder, DraftScene& draft) {
  if (!can_be_flown(written, intruder)) return hovering(clean, intruder);
  OrProblem<Trajectory> made = scene_trajectory(clean, intruder, draft.scene);
  return made_or_fallback(std::move(made), hovering(clean, intruder), draft.problems);
}

std::shared_ptr<const Model> drafted_model(const Project& clean, std::size_t intruder, DraftScene& draft,
                                           SceneFiles& files) {
  OrProblem<std::shared_ptr<const Model>> model = scene_model(clean, intruder, files);
  if (model) return *model;
  note(draft.problems, model.error());
  const double length_m = clean.intruders[intruder].model.length_m;
  return files.cross(length_m > 0 ? length_m : kCrossLength_m);
}

}  // namespace

DraftScene draft_scene(const Project& project, const FootageShape& footage, SceneFiles& files) {
  ENSURE(!footage.times_s.empty() && !footage.size_px.empty());
  const Project clean = sanitized(project);
  DraftScene draft{.scene = bare_scene(clean, footage), .problems = checked(project)};
  Scene& scene = draft.scene;
  const FrameRange range =
      made_or_fallback(scene_range(clean.footage, footage), clamped_range(clean.footage, footage), draft.problems);
  scene.first_frame = range.first;
  scene.last_frame = range.last;
  scene.camera = made_or_fallback(scene_camera(clean, footage.size_px, files), placeholder_camera(footage.size_px),
                                  draft.problems);
  scene.motion.turns =
      made_or_fallback(scene_carrier_attitudes(clean, footage, files), std::vector<CarrierAttitude>(), draft.problems);
  scene.own_body = made_or_fallback(scene_own_body(clean, footage.size_px, files), cv::Mat(), draft.problems);
  for (std::size_t i = 0; i < clean.intruders.size(); ++i) {
    const bool has_waypoint = !clean.intruders[i].trajectory.waypoints.empty();
    draft.intruder_of_project.push_back(has_waypoint ? static_cast<int>(scene.intruders.size()) : -1);
    const std::shared_ptr<const Model> model = drafted_model(clean, i, draft, files);
    if (has_waypoint) add_intruder(scene, clean.intruders[i].name, model, drafted_trajectory(project, clean, i, draft));
  }
  scene.issues = plausibility_issues(clean, scene, draft.intruder_of_project);
  // Of what is wrong there is nothing to doubt.
  std::erase_if(scene.issues, [&](const Problem& issue) { return is_known(draft.problems, issue); });
  return draft;
}

FootageShape placeholder_footage(const Project& project) {
  const Project clean = sanitized(project);
  double last = std::max(clean.footage.first_frame, clean.footage.last_frame.value_or(0));
  for (const IntruderSettings& intruder : clean.intruders)
    for (const WaypointSettings& waypoint : intruder.trajectory.waypoints)
      last = std::max(last, std::ceil(waypoint.frame.value_or(0)));
  const int count = static_cast<int>(std::clamp<double>(last + 1, kMinFrames, kMaxFrames));
  // The size that the calibration is made for: else a second fault would be seen where there is one.
  const Result<Camera> camera =
      read_calibration(resolved(clean, clean.footage.calibration), {}, lens_model_of(clean.footage.lens_model));
  FootageShape footage{.size_px = camera ? camera->size_px : cv::Size(kPlaceholderWidth_px, kPlaceholderHeight_px),
                       .frame_interval_s = kPlaceholderInterval_s};
  for (int frame = 0; frame < count; ++frame) footage.times_s.push_back(frame * kPlaceholderInterval_s);
  return footage;
}

}  // namespace sigs
