// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "flights/camera_path.h"
#include "flights/terrain.h"

namespace sigs::flights {

// The terrain as the camera sees it: CV_8UC3, blue green red. cloudiness: 0 a clear sky, 1 as the terrain has it.
[[nodiscard]] cv::Mat scenery(const Terrain& terrain, const View& view, double cloudiness);

}  // namespace sigs::flights
