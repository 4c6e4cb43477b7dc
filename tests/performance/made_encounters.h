// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/random.h"
#include "performance/observations.h"
#include "performance/sensor_model.h"

namespace sigs::test {

// A sensor that is known exactly: it detects where (reach_m - range) / slope_m + noise > 0. The noise is standard
// normal: one part an encounter has throughout, the rest anew for each frame.
struct MadeSensor {
  double reach_m = 800;
  double slope_m = 200;
  double encounter_share = 0.3;
  double below_shift = 0;  // added for intruders below the horizon

  // The range at which it detects with this probability.
  [[nodiscard]] double range_at(double probability) const { return reach_m - slope_m * normal_quantile(probability); }
};

// Approaches from 1600 m to 50 m at 60 m/s, ten frames a second; every second of them is below the horizon.
inline std::vector<ObservedEncounter> made_encounters(const MadeSensor& sensor, int count, Random& random) {
  std::vector<ObservedEncounter> encounters;
  for (int i = 0; i < count; ++i) {
    ObservedEncounter encounter{
        .clip = "clip " + std::to_string(i), .name = "jet", .tags = {}, .frames = {}, .drop_outs = {}};
    const double own = std::sqrt(sensor.encounter_share) * normal_number(random);
    const double begin_m = 1600 - 60 * random.uniform();
    for (int frame = 0; begin_m - 6 * frame > 50; ++frame) {
      SeenFrame seen{.frame = frame, .time_s = frame / 10.0, .range_m = begin_m - 6 * frame};
      seen.horizon = i % 2 == 0 ? HorizonSide::above : HorizonSide::below;
      const double shift = i % 2 == 0 ? 0 : sensor.below_shift;
      const double noise = own + std::sqrt(1 - sensor.encounter_share) * normal_number(random);
      seen.is_detected = (sensor.reach_m - seen.range_m) / sensor.slope_m + shift + noise > 0;
      encounter.frames.push_back(seen);
    }
    int hits = 0;
    for (std::size_t k = 0; k < encounter.frames.size(); ++k) {
      hits += encounter.frames[k].is_detected ? 1 : 0;
      if (k >= 5) hits -= encounter.frames[k - 5].is_detected ? 1 : 0;
      encounter.frames[k].is_declared = hits >= 3 || encounter.declared.has_value();
      if (hits >= 3 && !encounter.declared)
        encounter.declared = {
            .time_s = encounter.frames[k].time_s, .range_m = encounter.frames[k].range_m, .time_left_s = 0};
    }
    encounters.push_back(std::move(encounter));
  }
  return encounters;
}

}  // namespace sigs::test
