// SPDX-License-Identifier: MIT
#include "scene/encounter_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace sigs {

namespace {

EncounterTrack bare_track(const Scene& scene, std::string name) {
  return {.name = std::move(name),
          .first_s = time_of_frame_s(scene.footage, scene.first_frame),
          .last_s = time_of_frame_s(scene.footage, scene.last_frame)};
}

}  // namespace

EncounterTrack encounter_track_of_camera(const Scene& scene) {
  EncounterTrack track = bare_track(scene, "camera");
  if (scene.motion.path) {
    track.knots_s = scene.motion.path->knots_s();
    track.at = [path = scene.motion.path](double time_s) {
      const Motion motion = path->motion_at(time_s);
      return AircraftState{motion.position_m, motion.velocity_mps};
    };
    return track;
  }
  // As camera_at() of scene_at.h.
  const glm::dvec3 start_m = scene.motion.world_from_camera_at_start.translation_m;
  track.at = [start_m, velocity_mps = glm::dvec3(scene.motion.speed_mps, 0, 0)](double time_s) {
    return AircraftState{start_m + time_s * velocity_mps, velocity_mps};
  };
  return track;
}

EncounterTrack encounter_track_of_intruder(const Scene& scene, std::size_t intruder) {
  EncounterTrack track = bare_track(scene, scene.intruders[intruder].name);
  track.at = [trajectory = scene.intruders[intruder].trajectory](double time_s) {
    return AircraftState{trajectory.position_m(time_s), trajectory.velocity_mps(time_s)};
  };
  return track;
}

std::vector<EncounterTrack> encounter_tracks_of(const Scene& scene, const FrameRange& frames) {
  std::vector<EncounterTrack> tracks{encounter_track_of_camera(scene)};
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) tracks.push_back(encounter_track_of_intruder(scene, i));
  std::map<std::string, int> seen;
  for (EncounterTrack& track : tracks) {
    if (const int before = seen[track.name]++; before > 0) track.name += fmt::format("-{}", before + 1);
    track.first_s = time_of_frame_s(scene.footage, frames.first);
    track.last_s = time_of_frame_s(scene.footage, frames.last);
  }
  return tracks;
}

std::vector<double> times_of_frames_s(const Scene& scene) {
  return times_of_frames_s(scene, {scene.first_frame, scene.last_frame});
}

std::vector<double> times_of_frames_s(const Scene& scene, const FrameRange& frames) {
  std::vector<double> times_s;
  for (int frame = frames.first; frame <= frames.last; ++frame)
    times_s.push_back(time_of_frame_s(scene.footage, frame));
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  return times_s;
}

}  // namespace sigs
