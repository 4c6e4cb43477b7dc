// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"
#include "telemetry/read_track.h"
#include "telemetry/track.h"
#include "video/data_streams.h"

namespace sigs {

// Whether a stream of a container is GoPro's telemetry.
[[nodiscard]] bool is_gopro(const DataStream& stream);

// Reads it. Errors as those of read_track().
[[nodiscard]] Result<Track> read_gopro(const std::filesystem::path& file, const DataStream& stream,
                                       const ReadTrackOptions& options);

}  // namespace sigs
