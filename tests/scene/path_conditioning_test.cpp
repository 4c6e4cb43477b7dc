// SPDX-License-Identifier: MIT
#include "scene/plausibility.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "scene/draft.h"
#include "scene/opened_project.h"
#include "scene/sample_scenes.h"

namespace sigs::test {
namespace {

constexpr int kFrames = 100'100;

FootageShape long_footage() {
  FootageShape footage{.size_px = {1280, 960}, .frame_interval_s = 0.04};
  for (int frame = 0; frame < kFrames; ++frame) footage.times_s.push_back(frame / 25.0);
  return footage;
}

// Three metres in the first frame, nine kilometres in the next 1e5.
Project ill_conditioned_project() {
  Project project = sample_project("crossing");
  IntruderSettings& intruder = project.intruders.front();
  intruder.name = "late bird";
  intruder.trajectory = {.waypoints = {{.frame = 0, .position_m = {500, 0, -150}},
                                       {.frame = 1, .position_m = {503, 0, -150}},
                                       {.frame = 100'001, .position_m = {9503, 0, -150}},
                                       {.frame = 100'002, .position_m = {9506, 0, -150}}}};
  return project;
}

Scene opened(const Project& project) {
  Result<Scene> scene = open_scene(project, long_footage());
  if (!scene) FAIL(scene.error().text());
  return std::move(*scene);
}

}  // namespace

TEST_CASE("a path that overshoots far beyond its waypoints is reported with intruder and frames and what to do") {
  const Scene scene = opened(ill_conditioned_project());
  REQUIRE(scene.issues.size() == 1);
  CHECK(scene.issues.front().field == "intruders[0].trajectory");
  const std::string text = scene.issues.front().what;
  CHECK(text.find("\"late bird\" overshoots ") != std::string::npos);
  CHECK(text.find("of frames 1 and 100001, where no leg is longer than 9000 m") != std::string::npos);
  CHECK(text.find("approximating") != std::string::npos);
}

TEST_CASE("each remedy that the warning names removes the overshoot") {
  Project spread = ill_conditioned_project();
  for (const std::size_t inner : {1U, 2U}) spread.intruders[0].trajectory.waypoints[inner].frame.reset();
  CHECK(opened(spread).issues.empty());

  Project approximating = ill_conditioned_project();
  approximating.intruders[0].trajectory.spline = SplineKind::approximating;
  CHECK(opened(approximating).issues.empty());

  Project more = ill_conditioned_project();
  std::vector<WaypointSettings>& waypoints = more.intruders[0].trajectory.waypoints;
  // The speed of the short leg decays over legs that grow tenfold.
  for (const double frame : {10'001.0, 1'001.0, 101.0, 11.0})
    waypoints.insert(waypoints.begin() + 2, {.frame = frame, .position_m = {503 + 0.09 * (frame - 1), 0, -150}});
  for (const double frame : {90'001.0, 99'001.0, 99'901.0, 99'991.0})
    waypoints.insert(waypoints.end() - 2, {.frame = frame, .position_m = {503 + 0.09 * (frame - 1), 0, -150}});
  CHECK(opened(more).issues.empty());
}

TEST_CASE("constant speed along the same curve does not remove the overshoot") {
  Project project = ill_conditioned_project();
  project.intruders[0].trajectory.timing = Timing::constant_speed;
  CHECK(opened(project).issues.size() == 1);
}

TEST_CASE("the draft has the warnings of the opened scene") {
  SceneFiles files;
  const DraftScene draft = draft_scene(ill_conditioned_project(), long_footage(), files);
  CHECK(draft.problems.empty());
  REQUIRE(draft.scene.issues.size() == 1);
  CHECK(draft.scene.issues.front().what == opened(ill_conditioned_project()).issues.front().what);
}

TEST_CASE("the sample projects overshoot nowhere and are well conditioned") {
  for (const char* const name : kSampleProjects) {
    CAPTURE(name);
    const Project project = sample_project(name);
    const Result<Scene> scene = open_scene(project, sample_footage());
    REQUIRE(scene.has_value());
    CHECK(scene->issues.empty());
    CHECK(scene->warnings.empty());
    for (std::size_t i = 0; i < project.intruders.size(); ++i) {
      const std::optional<double> condition = path_condition(project, i, *scene);
      REQUIRE(condition.has_value());
      CHECK(*condition < 3);
    }
  }
}

TEST_CASE("the condition of a path of one frame and 1e5 frames is large, that of an approximating one is none") {
  Project project = ill_conditioned_project();
  const Scene scene = opened(project);
  CHECK(path_condition(project, 0, scene).value() > 1e4);
  project.intruders[0].trajectory.spline = SplineKind::approximating;
  CHECK(!path_condition(project, 0, scene));
}

}  // namespace sigs::test
