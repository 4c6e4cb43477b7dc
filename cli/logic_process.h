// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"
#include "performance/risk.h"

namespace sigs::cli {

// Starts a program by the shell that decides on manoeuvres. For each question it gets a line of JSON on its standard
// input, {"encounter", "time_s", "bearing_deg", "elevation_deg", "bearing_rate_deg_s",
// "elevation_rate_deg_s", "range_m", "own_speed_mps"} (range_m is null where the
// sensor states none), and answers with a manoeuvre's name on a line. It ends when its input does. Errors unavailable:
// it cannot be started; bad_data: it ends, or answers anything else.
[[nodiscard]] Result<Logic> logic_of_command(const std::string& command);

}  // namespace sigs::cli
