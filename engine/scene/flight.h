// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
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

// The motion of an intruder at one moment. The load factors are the specific force (acceleration - gravity) along an
// axis of the aircraft, in units of g.
struct FlightState {
  double time_s = 0;
  glm::dvec3 position_m{0, 0, 0};  // world
  double speed_mps = 0;
  double climb_rate_mps = 0;    // positive upward
  double load_factor = 1;       // along the aircraft's own up axis; 1 in level flight
  double side_load_factor = 0;  // along the right wing; 0 in a coordinated turn
  double bank_rad = 0;
};

// time_s: of the footage; before and after the trajectory as it extrapolates.
[[nodiscard]] FlightState flight_at(const SceneIntruder& intruder, double time_s);

// The moment at which an intruder's reference point is nearest to the camera.
struct ClosestApproach {
  double frame = 0;  // fractional: also between frames
  double time_s = 0;
  double distance_m = 0;
};

// Within the scene's range of frames; of several moments of equal distance the earliest. The distance is sampled four
// times a frame and refined by golden section search.
//   intruder  index in scene.intruders
[[nodiscard]] ClosestApproach closest_approach(const Scene& scene, int intruder);

// The flight limits of aircraft of some size, not of a particular type.
struct FlightLimits {
  double highest_speed_mps = 0;
  double highest_climb_mps = 0;  // also of descent
  double highest_load_factor = 0;
  double lowest_load_factor = 0;
};

// Load factors of CS-25 (2.5, -1) for aircraft longer than 18 m, else of CS-23, normal category (3.8, -1.52). Speeds
// and climb rates are those that no civil aircraft of the size in service exceeds. length_m: extent along the nose.
[[nodiscard]] FlightLimits limits_of(double length_m);

enum class FlightFault { speed, climb, load, underground };

// A stretch of frames in which a limit is exceeded. The ground is z = 0.
struct FlightFlag {
  FlightFault fault = FlightFault::speed;
  double first_frame = 0;
  double last_frame = 0;
  double worst = 0;  // value farthest beyond the limit: m/s, m/s (descent is negative), g, metres below the ground
  double limit = 0;  // in the same unit and with the same sign

  // "load factor 5.2, at most 2.5 for an aircraft of this size"
  [[nodiscard]] std::string text() const;
};

// By rising first_frame. The scene's range is sampled three times a frame, at most 6000 times in all. The highest load
// factor limits the length of load_factor and side_load_factor together: a tight turn with level wings cannot be flown.
//   intruder  index in scene.intruders
[[nodiscard]] std::vector<FlightFlag> flight_flags(const Scene& scene, int intruder);

}  // namespace sigs
