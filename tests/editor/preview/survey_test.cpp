// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

#include "base/pose.h"
#include "editor/preview/surveys.h"
#include "export/export_project.h"
#include "preview_client.h"
#include "scene/opened_project.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace {

bool is_whole(const std::shared_ptr<const Survey>& survey, std::size_t frames) {
  return survey && survey->estimates.size() == frames;
}

// A scene of very many frames at 50 a second.
std::shared_ptr<const OpenedScene> long_scene(int frames) {
  FootageShape shape{.size_px = {1280, 960}, .frame_interval_s = 0.02};
  for (int i = 0; i < frames; ++i) shape.times_s.push_back(0.02 * i);
  SceneFiles files;
  return std::make_shared<const OpenedScene>(
      OpenedScene{.revision = 9, .draft = draft_scene(sample("two-intruders"), shape, files)});
}

}  // namespace

TEST_CASE("the survey is what the engine says of each frame") {
  Project project = sample("two-intruders");
  project.footage.first_frame = 12;
  project.footage.last_frame = 160;
  PreviewClient preview_client;
  preview_client.want({.revision = revision(4, project), .frame = 12, .range_first = 12, .range_last = 160});
  const PreviewOutput shown = preview_client.wait([](const PreviewOutput& s) {
    return s.surveys.size() == 2 && is_whole(s.surveys[0], 149) && is_whole(s.surveys[1], 149);
  });

  const FrameSource source = FrameSource::open(resolved(project, project.footage.video)).value();
  const Scene scene = open_scene(project, shape_of(source.info())).value();
  const VisibilityEstimator points(scene);
  for (int id = 0; id < 2; ++id) {
    const Survey& survey = *shown.surveys[static_cast<std::size_t>(id)];
    CHECK(survey.revision == 4);
    CHECK(survey.first_frame == 12);
    REQUIRE(survey.flight.size() == 149);
    for (std::size_t i = 0; i < 149; ++i) {
      const int frame = 12 + static_cast<int>(i);
      const VisibilityEstimate estimate = points.at(id, frame);
      CHECK(survey.estimates[i].frame == frame);
      CHECK(survey.estimates[i].distance_m == estimate.distance_m);
      CHECK(survey.estimates[i].size_px == estimate.size_px);
      CHECK(survey.estimates[i].visibility_state == estimate.visibility_state);
      const FlightState flight =
          flight_at(scene.intruders[static_cast<std::size_t>(id)], time_of_frame_s(scene.footage, frame));
      CHECK(survey.flight[i].speed_mps == flight.speed_mps);
      CHECK(survey.flight[i].load_factor == flight.load_factor);
    }
    CHECK(survey.closest.frame == closest_approach(scene, id).frame);
    CHECK(survey.flags.size() == flight_flags(scene, id).size());
  }
}

TEST_CASE("a long survey is made in slices and grows") {
  constexpr int kFrames = 20000;
  SurveyBuilder maker;
  CHECK(maker.done());
  maker.begin(long_scene(kFrames));
  double max_duration_s = 0;
  int slices = 0;
  int showings = 0;
  std::size_t before = 0;
  while (!maker.done()) {
    const auto start = std::chrono::steady_clock::now();
    const bool worth_showing = maker.work(0.003);
    max_duration_s =
        std::max(max_duration_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    ++slices;
    if (!worth_showing) continue;
    ++showings;
    const auto surveys = maker.surveys();
    REQUIRE(surveys.size() == 2);
    CHECK(surveys[0]->estimates.size() >= before);
    CHECK(surveys[0]->estimates.size() == surveys[0]->flight.size());
    CHECK(surveys[1]->estimates.size() == surveys[0]->estimates.size());
    before = surveys[0]->estimates.size();
  }
  CHECK(before == kFrames);
  CHECK(slices > 10);
  CHECK(showings >= 5);
  CHECK(showings <= 30);  // each copies all there is
  MESSAGE("slices " << slices << ", longest " << max_duration_s * 1e3 << " ms");
  CHECK(max_duration_s < 0.25);  // 3 ms where no other process uses the core
}

TEST_CASE("a camera that turns on and on has a yaw without jumps") {
  CameraMotion motion;
  for (int i = 0; i <= 80; ++i)
    motion.attitudes.push_back({0.1 * i, rotation_of({.roll_rad = 0.1, .yaw_rad = rad_of_deg(10.0 * i)})});
  CameraTurn turn = camera_turn_at(motion, 0, nullptr);
  for (int i = 1; i <= 80; ++i) turn = camera_turn_at(motion, 0.1 * i, &turn);
  CHECK(deg_of_rad(turn.attitude.yaw_rad) == doctest::Approx(800));
  CHECK(turn.attitude.roll_rad == doctest::Approx(0.1));
  CHECK_FALSE(turn.sd.has_value());
}

TEST_CASE("deviations of roll, pitch and yaw are those of turns about the camera's axes, tried one by one") {
  const Attitude at{.roll_rad = 0.5, .pitch_rad = -0.4, .yaw_rad = 1};
  const glm::dvec3 sd_rad{0.002, 0.003, 0.001};
  CameraMotion motion;
  motion.attitudes = {{0, rotation_of(at)}};
  motion.deviations = {{0, sd_rad}};
  double roll = 0, pitch = 0, yaw = 0;  // variances by differences
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit{0, 0, 0};
    unit[axis] = 1;
    const Attitude turned = attitude_of(rotation_of(at) * glm::angleAxis(sd_rad[axis], unit));
    roll += std::pow(turned.roll_rad - at.roll_rad, 2);
    pitch += std::pow(turned.pitch_rad - at.pitch_rad, 2);
    yaw += std::pow(turned.yaw_rad - at.yaw_rad, 2);
  }
  const CameraTurn turn = camera_turn_at(motion, 0, nullptr);
  REQUIRE(turn.sd.has_value());
  // Differences of 3 mrad are linear to some thousandths.
  CHECK(turn.sd->roll_rad == doctest::Approx(std::sqrt(roll)).epsilon(0.005));
  CHECK(turn.sd->pitch_rad == doctest::Approx(std::sqrt(pitch)).epsilon(0.005));
  CHECK(turn.sd->yaw_rad == doctest::Approx(std::sqrt(yaw)).epsilon(0.005));
}

TEST_CASE("each survey has the camera's turns in all frames, and none where nothing turns it") {
  SurveyBuilder still;
  still.begin(long_scene(50));
  while (!still.done()) still.work(0.01);
  CHECK(still.surveys()[0]->camera.empty());
  OpenedScene turned = *long_scene(50);
  turned.draft.scene.motion.attitudes = {{0, {1, 0, 0, 0}}, {0.98, rotation_of({.pitch_rad = 0.49})}};
  SurveyBuilder maker;
  maker.begin(std::make_shared<const OpenedScene>(std::move(turned)));
  while (!maker.done()) maker.work(0.01);
  for (const auto& survey : maker.surveys()) {
    REQUIRE(survey->camera.size() == 50);
    // 0.5 rad a second, less the sample's own mounting, which is level.
    CHECK(survey->camera[25].attitude.pitch_rad - survey->camera[0].attitude.pitch_rad == doctest::Approx(0.25));
  }
}

TEST_CASE("an encounter is surveyed where it is wanted, anew for other volumes, and not where nobody shows it") {
  SurveyBuilder maker;
  maker.begin(long_scene(200));
  while (!maker.done()) (void)maker.work(1);
  CHECK(maker.surveys()[0]->encounter == nullptr);
  maker.want_volumes({well_clear_volume("small-uas").value()});
  CHECK_FALSE(maker.done());
  while (!maker.done()) CHECK(maker.work(1));
  const auto first = maker.surveys();
  REQUIRE(first[0]->encounter != nullptr);
  REQUIRE(first[1]->encounter != nullptr);
  CHECK(first[0]->estimates.size() == 200);
  CHECK(first[0]->encounter->horizontal_range_m.size() == 200);
  maker.want_volumes({well_clear_volume("small-uas").value()});  // the same
  CHECK(maker.done());
  maker.want_volumes({well_clear_volume("nmac").value(), well_clear_volume("dwc-terminal").value()});
  while (!maker.done()) (void)maker.work(1);
  CHECK(maker.surveys()[0]->encounter->volumes.size() == 2);
  maker.want_volumes({});
  CHECK(maker.done());
}
