// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>

#include "base/result.h"
#include "telemetry/track.h"

namespace sigs {

struct ReadTrackOptions {
  const std::atomic<bool>* cancel = nullptr;  // set to true: ends soon with the error `interrupted`
};

// Reads a flight log; the format is recognised by the content, not by the name: a video with GoPro GPMF, DJI subtitles
// or MISB KLV in it, DJI .srt, PX4 ULog, ArduPilot dataflash, a bare KLV stream, CSV with named columns.
// A damaged file gives what stands before the damage, with `damaged` set and a warning that says where.
// Errors: cannot_read, bad_data (no known format, no telemetry in it, or nothing sound), interrupted.
[[nodiscard]] Result<Track> read_track(const std::filesystem::path& file, const ReadTrackOptions& options = {});

// Whether one of these formats recognises the file or a stream in it, though nothing in it may be sound.
[[nodiscard]] bool carries_telemetry(const std::filesystem::path& file);

}  // namespace sigs
