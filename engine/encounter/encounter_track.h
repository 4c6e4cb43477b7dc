// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "encounter/relative_motion.h"

namespace sigs {

// The flight of one aircraft: position and velocity at every time between two. Exact paths give their own function,
// recorded ones are made by track_of().
struct EncounterTrack {
  std::string name;
  double first_s = 0;
  double last_s = 0;  // at least first_s

  // At a time from first_s to last_s. The velocity is the derivative of the position; at a jump of it, the one after.
  // Depends on the time alone.
  std::function<AircraftState(double time_s)> at;

  // Rising times at which the velocity or one of its derivatives jumps. Times that are not named cost accuracy: jumps
  // of the velocity are then found to 1 ms.
  std::vector<double> knots_s = {};
};

struct TrackSample {
  double time_s = 0;
  AircraftState state;
};

// A flight as recorded: states at some times.
struct SampledTrack {
  std::string name;
  std::vector<TrackSample> samples;  // by rising time
  bool has_velocities = false;       // false: velocities of the samples are not known, and are not read
};

// At least one sample, all numbers finite, times strictly rising. Error bad_data that names the track and the sample.
[[nodiscard]] Result<void> check_track(const SampledTrack& track);

// Between two samples, where velocities are known: the cubic with both positions and both velocities (Hermite), so that
// position and velocity are continuous and are the recorded ones at the samples. Where they are not known: straight
// at constant velocity; at a sample the velocity is that of the stretch after it, at the last one that before. A single
// sample without velocity hovers.
//   track  such as check_track() accepts
[[nodiscard]] EncounterTrack track_of(SampledTrack track);

}  // namespace sigs
