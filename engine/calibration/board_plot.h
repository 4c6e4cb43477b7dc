// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "calibration/board_calibration.h"

namespace sigs {

// Four panels, BGR, 8 bits: the residuals of the chosen model as arrows where they are in the image, means of cells;
// how many corners were seen in each cell of the image; the residuals by their distance from the principal point, for
// each model; the error of each view, used and not used.
[[nodiscard]] cv::Mat board_plot(const BoardCalibration& calibration);

}  // namespace sigs
