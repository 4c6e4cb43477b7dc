// SPDX-License-Identifier: MIT
#include "scene/posed_intruder.h"

#include <doctest/doctest.h>

#include <cmath>

#include "scene/sample_scenes.h"

using namespace sigs;
using namespace sigs::test;

namespace {

constexpr int kPosedFrame = 100;

// Distance from the camera, some frames after the pose's frame.
double posed_distance_m(const Project& project, const Scene& scene, int frames) {
  const double time_s = time_of_frame_s(scene.footage, kPosedFrame + frames);
  return glm::length(scene.intruders.front().trajectory.position_m(time_s) - project.camera.position_m);
}

}  // namespace

TEST_CASE("what is seen at a distance grows by the share per second that a pose asks for") {
  const Project project = sample_project("crossing");
  SceneFiles files;
  IntruderPose pose{.middle_px = {700, 400}, .width_px = 40, .aspect = 3};
  for (const double growth_per_s : {-0.5, -0.05, 0.05, 0.5}) {
    for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
      pose.growth_per_s = growth_per_s;
      pose.seed = seed;
      const Result<Scene> scene = posed_scene(project, sample_footage(), files, kPosedFrame, pose);
      REQUIRE_MESSAGE(scene, scene.error().text());
      // The size goes with 1 / distance. Over one frame of 0.04 s either way, the change of its rate is of second
      // order: (0.5 * 0.04)^2 of it.
      const double grown = std::log(posed_distance_m(project, *scene, -1) / posed_distance_m(project, *scene, 1));
      CAPTURE(growth_per_s);
      CAPTURE(seed);
      CHECK(grown / 0.08 == doctest::Approx(growth_per_s).epsilon(0.002));
    }
  }
}

TEST_CASE("what is to keep its size flies so slowly that it does, and without a wish at its own speed") {
  const Project project = sample_project("crossing");
  SceneFiles files;
  IntruderPose pose{.middle_px = {700, 400}, .width_px = 40, .aspect = 3};
  const auto speed_mps = [&] {
    const Result<Scene> scene = posed_scene(project, sample_footage(), files, kPosedFrame, pose);
    REQUIRE_MESSAGE(scene, scene.error().text());
    const Trajectory& path = scene->intruders.front().trajectory;
    const double from_s = time_of_frame_s(scene->footage, kPosedFrame - 5);
    const double to_s = time_of_frame_s(scene->footage, kPosedFrame + 5);
    return glm::length(path.position_m(to_s) - path.position_m(from_s)) / (to_s - from_s);
  };
  CHECK(speed_mps() == doctest::Approx(60));
  pose.growth_per_s = 0;
  CHECK(speed_mps() == doctest::Approx(1));
}
