// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lanes.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include "editor/preview/preview_output.h"
#include "editor/widgets/theme.h"
#include "scene/scene_parts.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

// The camera hovers; the intruder comes at 100 m/s from 2000 m to the east of it, 20 m above, through its place.
Scene overflown() {
  FootageShape shape{.size_px = {1280, 960}};
  for (int i = 0; i <= 1000; ++i) shape.times_s.push_back(0.04 * i);
  Project project;
  project.camera.position_m = {0, 0, -150};
  Scene scene = bare_scene(project, shape);
  scene.first_frame = 100;
  scene.last_frame = 1000;
  scene.intruders.push_back(
      {.name = "intruder", .trajectory = Trajectory::make({{0, {0, 2000, -170}}, {40, {0, -2000, -170}}}, {}).value()});
  return scene;
}

}  // namespace

TEST_CASE("the volumes that are shown are those of the export, else that of small aircraft") {
  Project project;
  REQUIRE(shown_volumes(project).size() == 1);
  CHECK(shown_volumes(project)[0].name == "small-uas");
  project.output.encounter = {"nmac", "unknown", "dwc-terminal"};
  REQUIRE(shown_volumes(project).size() == 2);
  CHECK(shown_volumes(project)[0].name == "nmac");
  CHECK(shown_volumes(project)[1].name == "dwc-terminal");
}

TEST_CASE("entry, exit and closest approach are where the closed form has them, and lead to frames within the loss") {
  const EncounterSurvey survey = encounter_survey(overflown(), 0, shown_volumes(Project()));
  // |s| = 2000 - 100 t; lost within 2000 ft = 609.6 m: from 13.904 s to 26.096 s, frames 347.6 to 652.4.
  REQUIRE(survey.volumes.size() == 1);
  REQUIRE(survey.volumes[0].losses.size() == 1);
  const LossStretch& loss = survey.volumes[0].losses[0];
  CHECK(loss.first_frame == doctest::Approx(347.6).epsilon(1e-9));
  CHECK(loss.last_frame == doctest::Approx(652.4).epsilon(1e-9));
  CHECK(loss.entry_frame() == 348);
  CHECK(loss.exit_frame() == 652);
  CHECK(survey.nearest_frame == doctest::Approx(500));
  CHECK(survey.nearest.vertical_m == doctest::Approx(20));
  CHECK_FALSE(survey.is_lost(0, 347));
  CHECK(survey.is_lost(0, 348));
  CHECK(survey.is_lost(0, 652));
  CHECK_FALSE(survey.is_lost(0, 653));

  REQUIRE(survey.horizontal_range_m.size() == 901);
  CHECK(survey.horizontal_range_m[0] == doctest::Approx(1600));  // at 4 s
  // (609.6^2 - 1600^2) / (1600 * -100)
  CHECK(survey.tau_mod_s[0] == doctest::Approx(13.6774).epsilon(1e-4));
  CHECK(survey.tau_mod_s[400] == 0);
  CHECK(std::isinf(survey.tau_mod_s[900]));

  const std::vector<EncounterMark> marks = encounter_marks(survey);
  REQUIRE(marks.size() == 3);
  CHECK(marks[0].kind == EncounterMark::Kind::entry);
  CHECK(marks[0].go_to == 348);
  CHECK(marks[0].text == "well clear lost (small-uas) at 13.904 s");
  CHECK(marks[1].kind == EncounterMark::Kind::closest);
  CHECK(marks[1].go_to == 500);
  CHECK(marks[2].kind == EncounterMark::Kind::exit);
  CHECK(marks[2].go_to == 652);
}

TEST_CASE("a clip that begins and ends within the volume has neither an entry nor an exit") {
  Scene scene = overflown();
  scene.first_frame = 400;
  scene.last_frame = 600;
  const std::vector<EncounterMark> marks = encounter_marks(encounter_survey(scene, 0, shown_volumes(Project())));
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].kind == EncounterMark::Kind::closest);
}

TEST_CASE("a loss between two frames leads to the nearer one") {
  const LossStretch brief{.first_frame = 10.6, .last_frame = 10.9};
  CHECK(brief.entry_frame() == 11);
  CHECK(brief.exit_frame() == 11);
}

TEST_CASE("a mark is taken where the mouse is near, and of two the nearer one") {
  ImGui::CreateContext();
  load_fonts(15);
  const EncounterSurvey survey = encounter_survey(overflown(), 0, shown_volumes(Project()));
  const std::vector<EncounterMark> marks = encounter_marks(survey);
  const TimelineStrip strip{.ruler = {.left_x = 100, .width = 1000, .first = 0, .count = 1000}};
  const auto at = [&](double x) { return mark_at(marks, strip, x); };
  REQUIRE(at(448.1) != nullptr);  // frame 347.6, the middle of its cell
  CHECK(at(448.1)->kind == EncounterMark::Kind::entry);
  CHECK(at(453) == &marks[0]);
  CHECK(at(460) == nullptr);
  CHECK(at(600.5) == &marks[1]);
  CHECK(mark_at({}, strip, 448) == nullptr);
  ImGui::DestroyContext();
}
