// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "encounter_model/sampled_track.h"

namespace sigs::cli {

// Flights drawn one below the other: from above in metres (north up, both axes to the same scale), and altitude in m,
// speed in m/s and vertical speed in m/s over time in s. BGR, 8 bits, 1200 pixels wide. Needs at least one flight.
[[nodiscard]] cv::Mat flights_plot(const std::vector<ModelFlight>& tracks);

}  // namespace sigs::cli
