// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"
#include "telemetry/read_track.h"
#include "telemetry/track.h"

namespace sigs {

// ArduPilot's dataflash logs (.bin; https://ardupilot.org/copter/docs/logmessages.html).

// Whether a file that begins so is one.
[[nodiscard]] bool is_dataflash(std::string_view head);

// Reads the file. Time 0 is the first stamp of a message that is read. Where several messages have a quantity, the
// first that has sound samples is taken: position of POS, GPS, AHR2 (heights above the mean sea); attitude of ATT,
// XKF1, NKF1, AHR2; velocity and local position of XKF1, NKF1, and velocity of GPS; rates and forces of IMU; camera of
// MNT. Of sensors and filters with several instances, the first one (0). UTC is that of the first GPS message with a
// three-dimensional fix, less the leap seconds of its date. Errors as those of read_track().
[[nodiscard]] Result<Track> read_dataflash(const std::filesystem::path& file, const ReadTrackOptions& options);

// The same of the bytes of a file.
[[nodiscard]] Result<Track> dataflash_track(std::string_view bytes, const std::filesystem::path& file,
                                            const ReadTrackOptions& options = {});

}  // namespace sigs
