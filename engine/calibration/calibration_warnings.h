// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/result.h"
#include "calibration/board_calibration.h"

namespace sigs {

// What a user should know of a calibration with a board: where its views do not support it. Each says what to do.
[[nodiscard]] std::vector<Warning> calibration_warnings(const BoardCalibration& calibration);

}  // namespace sigs
