// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "engine/made_scenes.h"
#include "project/fields.h"
#include "scene/draft.h"

namespace sigs::test {
namespace {

FootageShape footage_of(const Lot& lot) {
  return {.size_px = lot.size_px(), .times_s = {0, 0.04, 0.08}};
}

// A sound project with one aircraft well in view.
struct Sound {
  Sound() {
    write_obj(lot.path("aircraft.obj"), aircraft(), 1);
    lot.add("aircraft.obj", {60, 0, -150}).trajectory.waypoints.push_back({.frame = 2, .position_m = {61, 0, -150}});
    std::ofstream(lot.path("broken.obj")) << "v 0 0\n";
  }
  Lot lot;
};

ComposedFrame draft_frame(const Lot& lot, const Project& project, SceneFiles& files, int frame = 1) {
  const DraftScene draft = draft_scene(project, footage_of(lot), files);
  return composed(draft.scene, frame, even_frame(lot.size_px(), 100));
}

}  // namespace

TEST_CASE("the draft of a sound project gives the opened scene's bytes") {
  const Sound sound;
  SceneFiles files;
  const ComposedFrame draft = draft_frame(sound.lot, sound.lot.project, files);
  const ComposedFrame opened = composed(sound.lot.opened(), 1, even_frame(sound.lot.size_px(), 100));
  CHECK(same_planes(draft.picture, opened.picture));
  CHECK(cv::countNonZero(opened.mask) > 50);
}

TEST_CASE("a cross stands where the model would, as large as it would be") {
  const Sound sound;
  SceneFiles files;
  for (const char* const file : {"none.obj", "broken.obj", ""}) {
    Project project = sound.lot.project;
    project.intruders[0].model.file = file;
    project.intruders[0].model.length_m = 20;
    const ComposedFrame frame = draft_frame(sound.lot, project, files, 0);
    const cv::Rect box = box_of(frame.mask);
    // 20 m at 60 m with 300 px focal length: 100 px; blending may touch one more at each end.
    CHECK(std::abs(box.height - 100) <= 2);
    CHECK(std::abs(box.width - 100) <= 2);
    CHECK(box.contains(cv::Point(159, 119)));
  }
}

TEST_CASE("every file may be missing at once and the frame still has the crosses") {
  const Sound sound;
  Project project = sound.lot.project;
  project.footage.video = "";
  project.footage.calibration = "none.xml";
  project.footage.own_body_mask = "none.png";
  project.intruders[0].model.file = "none.obj";
  SceneFiles files;
  CHECK(cv::countNonZero(draft_frame(sound.lot, project, files).mask) > 10);
}

TEST_CASE("whatever number stands in whichever field, the draft can be composed") {
  const Sound sound;
  SceneFiles files;
  Bench bench;
  const Frame background = even_frame(sound.lot.size_px(), 100);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), -inf, 1e13, 0.0, -1.0}) {
    Project project = sound.lot.project;
    const std::size_t count = fields_of(project).size();
    for (std::size_t i = 0; i < count; ++i) {
      project = sound.lot.project;
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
      const DraftScene draft = draft_scene(project, footage_of(sound.lot), files);
      const Result<ComposedFrame> picture = compose_frame(draft.scene, 1, background, bench);
      CHECK_MESSAGE(picture.has_value(), (picture.has_value() ? std::string() : picture.error().text()));
    }
  }
}

}  // namespace sigs::test
