// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "flights/camera_path.h"
#include "flights/country.h"

namespace sigs::flights {

// The country as the camera sees it: CV_8UC3, blue green red. cloudiness: 0 a clear sky, 1 as the country has it.
[[nodiscard]] cv::Mat scenery(const Country& country, const View& view, double cloudiness);

}  // namespace sigs::flights
