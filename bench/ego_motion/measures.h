// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "accuracy/csv.h"
#include "attitude_flights/flight.h"
#include "attitude_flights/slip_score.h"
#include "ego_motion/ego_motion.h"

namespace sigs::bench {

// A flight on disk, with its truth.
struct MadeFlight {
  made::Flight flight;
  std::filesystem::path footage;
  std::string id;  // "own-body-1"
};

// Draws it where it is not yet in the folder; as H.264 with CRF 18, or lossless as FFV1. Stops the program where it
// cannot be written.
[[nodiscard]] MadeFlight made_flight(const accuracy::Call& call, const std::string& kind, std::uint32_t seed,
                                     bool lossless = false);

// An estimate and what it cost.
struct Measured {
  EgoMotion motion;
  made::SlipScore score;
  double level_error_rad = 0;  // between the world's true and estimated downward direction, at the middle frame
  double run_s = 0;            // processor time, with decoding
  double decode_s = 0;         // of decoding every frame, nothing else
};

// Runs the estimation once; telemetry and calibration are those of the flight. Nothing where the estimation fails; the
// reason is printed.
[[nodiscard]] std::optional<Measured> measured(const MadeFlight& flight, bool with_gyro,
                                               const EgoMotionSettings& settings);

// CSV files in the folder: cases.csv, all cases with images alone and with the gyroscope, seeds 1 and 2; sweep.csv,
// error against run time by number of features, size of the images and distance of key frames, and with lossless
// footage, seed 1.
void measure_cases(const accuracy::Call& call);
void measure_sweep(const accuracy::Call& call);

// Prints how the horizons of real clips are found: horizons.cpp.
void measure_horizons(const std::filesystem::path& truth);

}  // namespace sigs::bench
