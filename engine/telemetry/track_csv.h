// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"
#include "telemetry/read_track.h"
#include "telemetry/track.h"

namespace sigs {

// Whether a file that begins so is a flight log as CSV with named columns.
[[nodiscard]] bool is_track_csv(std::string_view head);

// Reads it. Errors as those of read_track().
[[nodiscard]] Result<Track> read_track_csv(const std::filesystem::path& file, const ReadTrackOptions& options);

}  // namespace sigs
