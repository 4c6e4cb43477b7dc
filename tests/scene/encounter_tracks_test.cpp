// SPDX-License-Identifier: MIT
#include "scene/flight.h"

#include <doctest/doctest.h>

#include "encounter/well_clear.h"
#include "project/project.h"
#include "scene/opened_project.h"
#include "scene/sample_scenes.h"
#include "scene/scene_at.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("a project names the volumes of well clear that there are") {
  std::vector<std::string> names;
  for (const WellClearVolume& volume : well_clear_volumes()) names.push_back(volume.name);
  CHECK(names == std::vector<std::string>(kWellClearNames.begin(), kWellClearNames.end()));
}

TEST_CASE("aircraft of one name get different names, over the frames asked for") {
  Scene scene = open_scene(sample_project(kSampleProjects[0]), sample_footage()).value();
  scene.intruders.assign(4, scene.intruders.at(0));
  scene.intruders[0].name = scene.intruders[1].name = "jet";
  scene.intruders[2].name = "camera";
  scene.intruders[3].name = "jet";
  std::vector<std::string> names;
  for (const EncounterTrack& track : encounter_tracks_of(scene, {3, 7})) {
    names.push_back(track.name);
    CHECK(track.first_s == time_of_frame_s(scene.footage, 3));
    CHECK(track.last_s == time_of_frame_s(scene.footage, 7));
  }
  CHECK(names == std::vector<std::string>{"camera", "jet", "jet-2", "camera-2", "jet-3"});
  CHECK(times_of_frames_s(scene, {3, 7}).size() == 5);
}

TEST_CASE("tracks of a scene are where its camera and its intruders are, and velocity is the change of place") {
  for (const char* const name : kSampleProjects) {
    CAPTURE(name);
    const Scene scene = open_scene(sample_project(name), sample_footage()).value();
    const EncounterTrack camera = encounter_track_of_camera(scene);
    CHECK(times_of_frames_s(scene).size() == static_cast<std::size_t>(scene.last_frame - scene.first_frame + 1));
    for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
      const EncounterTrack intruder = encounter_track_of_intruder(scene, i);
      CHECK(intruder.name == scene.intruders[i].name);
      CHECK(intruder.first_s == doctest::Approx(time_of_frame_s(scene.footage, scene.first_frame)));
      CHECK(intruder.last_s == camera.last_s);
      for (double t = intruder.first_s; t < intruder.last_s - 0.01; t += 0.173) {
        CHECK(glm::distance(camera.at(t).position_m, camera_at(scene.motion, t).translation_m) < 1e-9);
        CHECK(glm::length(camera_from_body_at(scene, i, t).translation_m) ==
              doctest::Approx(glm::distance(camera.at(t).position_m, intruder.at(t).position_m)).epsilon(1e-12));
        for (const EncounterTrack& track : {camera, intruder}) {
          // Accelerations below 50 m/s^2 change the velocity by less than the tolerance in this time.
          const glm::dvec3 change = (track.at(t + 1e-4).position_m - track.at(t).position_m) / 1e-4;
          CHECK(glm::distance(change, track.at(t).velocity_mps) < 5e-3);
        }
      }
    }
  }
}
