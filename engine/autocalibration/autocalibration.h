// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "autocalibration/division_lens.h"
#include "autocalibration/lens_by_motion.h"
#include "base/result.h"
#include "camera/calibration_text.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

// By what the focal length is known; the best first.
enum class AutocalibrationSource { given, gyroscope, turn, stated };

// For people: "the gyroscope".
[[nodiscard]] const char* name_of(AutocalibrationSource source);

struct AutocalibrationSettings {
  // Frames that are looked at; the more the better and the longer. 600 take about half as long as decoding ten seconds
  // of footage twice, and are enough for a first guess.
  int max_frames = 1800;
  std::optional<double> given_field_rad = {};  // horizontal field of view that the user knows; measured ones are
                                               // compared with it
};

// A lens found from footage without a board, and what every method said.
struct Autocalibration {
  AutocalibrationSource source = AutocalibrationSource::turn;
  LensEstimate fit;  // the lens, with the limits of its field of view

  GyroAnswer gyro;
  LensAnswer turn;
  LensAnswer stated;
  int frames = 0;                 // that were looked at
  std::vector<Warning> warnings;  // methods that disagree, pixels that are not square
};

// Finds the lens, in one pass over at most max_frames frames: by the gyroscope of the log, else by turns of the camera,
// else as the file states it.
//   log       of the same flight; null: none
//   log_file  where the log is from: it may state a field of view; empty: the footage itself
// Errors: bad_data (no method gives a field of view; the text says why each one does not, and what to do), those of
// FrameSource::read, interrupted.
[[nodiscard]] Result<Autocalibration> autocalibrated(FrameSource& footage, const Track* log,
                                                     const std::filesystem::path& log_file,
                                                     const AutocalibrationSettings& settings,
                                                     const AutocalibrationControl& control);

// The calibration as a file says it, marked as rough: its comment says by what it was found and how uncertain it is,
// and the numbers are rough_calibration (1), horizontal_field_deg, horizontal_field_low_deg, horizontal_field_high_deg
// (95 %), radial_distortion_sd. Error bad_data: parameters_of().
[[nodiscard]] Result<CalibrationText> calibration_text(const Autocalibration& found);

// One line for people: "field of view 74.3 degrees across (72.8 to 75.9), focal length 563 px, by the gyroscope".
[[nodiscard]] std::string summary_of(const Autocalibration& found);

// All that was found, as JSON (docs/calibrating-without-a-board.md).
[[nodiscard]] std::string json_of(const Autocalibration& found);

// Why the calibration is what it is, two diagrams, one below the other: the field of view by each method with its 95 %
// limits, or why there is none; and the angle from the axis that each distance from the image's centre shows, beside a
// pinhole's. BGR, 8 bits.
[[nodiscard]] cv::Mat autocalibration_plot(const Autocalibration& found);

}  // namespace sigs
