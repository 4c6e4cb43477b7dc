// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "calibration/rough_calibration.h"

namespace sigs {

// Why a rough calibration is what it is, CV_8UC3: the field of view by each method with its 95 % limits, or why there
// is none; and the angle from the axis that each distance from the image's centre shows, beside a pinhole's.
[[nodiscard]] cv::Mat rough_plot(const RoughCalibration& found);

}  // namespace sigs
