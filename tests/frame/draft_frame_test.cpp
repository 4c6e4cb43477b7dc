// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "frame/synthetic_scenes.h"
#include "project/fields.h"
#include "scene/draft.h"

namespace sigs::test {
namespace {

FootageShape footage_of(const Scenario& scenario) {
  return {.size_px = scenario.size_px(), .times_s = {0, 0.04, 0.08}};
}

// A valid project with one aircraft well in view.
struct ValidProject {
  ValidProject() {
    write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
    scenario.add("aircraft.obj", {60, 0, -150})
        .trajectory.waypoints.push_back({.frame = 2, .position_m = {61, 0, -150}});
    std::ofstream(scenario.path("broken.obj")) << "v 0 0\n";
  }
  Scenario scenario;
};

ComposedFrame draft_frame(const Scenario& scenario, const Project& project, SceneFiles& files, int frame = 1) {
  const DraftScene draft = draft_scene(project, footage_of(scenario), files);
  return composed(draft.scene, frame, even_frame(scenario.size_px(), 100));
}

}  // namespace

TEST_CASE("the draft of a valid project gives the opened scene's bytes") {
  const ValidProject valid;
  SceneFiles files;
  const ComposedFrame draft = draft_frame(valid.scenario, valid.scenario.project, files);
  const ComposedFrame opened = composed(valid.scenario.opened(), 1, even_frame(valid.scenario.size_px(), 100));
  CHECK(same_planes(draft.image, opened.image));
  CHECK(cv::countNonZero(opened.mask) > 50);
}

TEST_CASE("a cross has the model's place and size") {
  const ValidProject valid;
  SceneFiles files;
  for (const char* const file : {"none.obj", "broken.obj", ""}) {
    Project project = valid.scenario.project;
    project.intruders[0].model.file = file;
    project.intruders[0].model.length_m = 20;
    const ComposedFrame frame = draft_frame(valid.scenario, project, files, 0);
    const cv::Rect box = box_of(frame.mask);
    // 20 m at 60 m with 300 px focal length: 100 px; blending may touch one more at each end.
    CHECK(std::abs(box.height - 100) <= 2);
    CHECK(std::abs(box.width - 100) <= 2);
    CHECK(box.contains(cv::Point(159, 119)));
  }
}

TEST_CASE("with every file missing the frame still has the crosses") {
  const ValidProject valid;
  Project project = valid.scenario.project;
  project.footage.video = "";
  project.footage.calibration = "none.xml";
  project.footage.own_body_mask = "none.png";
  project.intruders[0].model.file = "none.obj";
  SceneFiles files;
  CHECK(cv::countNonZero(draft_frame(valid.scenario, project, files).mask) > 10);
}

TEST_CASE("with any number in any field, the draft can be composed") {
  const ValidProject valid;
  SceneFiles files;
  ComposeContext context;
  const Frame background = even_frame(valid.scenario.size_px(), 100);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), -inf, 1e13, 0.0, -1.0}) {
    Project project = valid.scenario.project;
    const std::size_t count = fields_of(project).size();
    for (std::size_t i = 0; i < count; ++i) {
      project = valid.scenario.project;
      const Field field = fields_of(project)[i];
      CAPTURE(field.key);
      CAPTURE(value);
      if (auto* const number = std::get_if<double*>(&field.value))
        **number = value;
      else if (auto* const vector = std::get_if<glm::dvec3*>(&field.value))
        **vector = glm::dvec3(value);
      else if (auto* const whole = std::get_if<int*>(&field.value))
        **whole = value > 0 ? std::numeric_limits<int>::max() : std::numeric_limits<int>::min();
      else if (auto* const frame = std::get_if<std::optional<double>*>(&field.value))
        **frame = value;
      else
        continue;
      const DraftScene draft = draft_scene(project, footage_of(valid.scenario), files);
      const Result<ComposedFrame> image = compose_frame(draft.scene, 1, background, context);
      CHECK_MESSAGE(image.has_value(), (image.has_value() ? std::string() : image.error().text()));
    }
  }
}

}  // namespace sigs::test
