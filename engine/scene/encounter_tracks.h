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

// The camera, then the intruders in their order, from the first to the last of these frames. Names differ: of several
// aircraft of one name the second has "-2" behind it, and so on.
[[nodiscard]] std::vector<EncounterTrack> encounter_tracks_of(const Scene& scene, const FrameRange& frames);

// Times of the frames, rising: those of equal times once. Without a range all frames of the scene.
[[nodiscard]] std::vector<double> times_of_frames_s(const Scene& scene);
[[nodiscard]] std::vector<double> times_of_frames_s(const Scene& scene, const FrameRange& frames);

}  // namespace sigs
