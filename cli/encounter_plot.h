// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "encounter/encounter.h"

namespace sigs::cli {

// Encounters over time: when well clear is lost, a lane for each volume; range; times (modified tau, closest approach);
// vertical offset with the volumes' limits, one below the other, for each encounter. BGR. Empty where no encounter has
// a row.
[[nodiscard]] cv::Mat encounter_plot(std::span<const EncounterSummary> encounters);

}  // namespace sigs::cli
