// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "encounter/encounter.h"

namespace sigs::cli {

// Encounters over time: range, times (modified tau, closest approach) and vertical offset with the volumes' limits,
// one below the other, for each encounter. The intervals of loss are shaded, each volume in a strip and a colour of its
// own, which the legend names. BGR. Empty where no encounter has a row.
[[nodiscard]] cv::Mat encounter_plot(std::span<const EncounterSummary> encounters);

}  // namespace sigs::cli
