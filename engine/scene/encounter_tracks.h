// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "encounter/encounter_track.h"
#include "scene/scene.h"

namespace sigs {

// The flights of a scene, for engine/encounter: exact paths over the time from the scene's first frame to its last.

// The camera, named "camera". Its course is that of its path, not where it looks.
[[nodiscard]] EncounterTrack encounter_track_of_camera(const Scene& scene);

//   intruder  index in Scene::intruders
[[nodiscard]] EncounterTrack encounter_track_of_intruder(const Scene& scene, std::size_t intruder);

// Times of the scene's frames, rising: those of equal times once.
[[nodiscard]] std::vector<double> times_of_frames_s(const Scene& scene);

}  // namespace sigs
