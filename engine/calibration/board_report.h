// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
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

// Four panels, BGR, 8 bits: the residuals of the chosen model as arrows where they are in the image, means of cells;
// how many corners were seen in each cell of the image; the residuals by their distance from the principal point, for
// each model; the error of each view, used and not used.
[[nodiscard]] cv::Mat board_plot(const BoardCalibration& calibration);

}  // namespace sigs
