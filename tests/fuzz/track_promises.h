// SPDX-License-Identifier: MIT
#pragma once

#include "fuzz/fuzz_input.h"
#include "telemetry/track.h"

namespace sigs::fuzz {

// Aborts unless the log keeps the promises of telemetry/track.h: times in order, everything finite, one time for each
// value; or is an error with a message.
void check_track_or_message(const Result<Track>& track);

}  // namespace sigs::fuzz
