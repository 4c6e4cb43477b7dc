// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/board.h"
#include "calibration/board_calibration.h"
#include "calibration/calibration_file.h"

namespace sigs {

// A calibration with a board for people, for programs, and as a file.

// A table of the models with errors and standard deviations, the one chosen marked.
[[nodiscard]] std::string board_report_text(const BoardCalibration& calibration);

// The same with all numbers and all views, as JSON (docs/calibrating.md lists the members).
[[nodiscard]] std::string board_report_json(const BoardCalibration& calibration, const CalibrationBoard& board);

// The chosen lens with its errors and standard deviations.
[[nodiscard]] CalibrationText calibration_text_of(const BoardCalibration& calibration, const CalibrationBoard& board);

}  // namespace sigs
