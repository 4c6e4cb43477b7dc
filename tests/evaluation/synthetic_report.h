// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "evaluation/reports/report.h"

namespace sigs::test {

inline constexpr const char* kSpecialName = "it's <b>&amp; \"50 %\", `date` @x \\n \xC3\xBC_{2}";

// A clip of 30 frames, in frames 20 to 24 of which the target is hidden. Trackers: one off by (3, 4) px in every frame,
// one of an unusual name that is correct in frames 0 to 9, silent in 10 to 14, present in 15 and silent afterwards, and
// one without any report.
[[nodiscard]] TrackReport synthetic_track_report();

// One encounter above the horizon, detected by the first detector in time, by the second not at all.
[[nodiscard]] DetectionReport synthetic_detection_report();

}  // namespace sigs::test
