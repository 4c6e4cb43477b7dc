// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"
#include "telemetry/read_track.h"
#include "telemetry/track.h"

namespace sigs {

// PX4's logs (https://docs.px4.io/main/en/dev_log/ulog_file_format); the topics are those of PX4's msg folder.

// Whether a file that begins so is a ULog.
[[nodiscard]] bool is_ulog(std::string_view head);

// Reads the file. Time 0 is the file's own stamp, the start of logging. Where several topics have a quantity, the first
// that has sound samples is taken: position of vehicle_global_position, vehicle_gps_position, sensor_gps, and last of
// vehicle_local_position with its reference; velocity of vehicle_local_position, then of the receiver; rates of
// vehicle_angular_velocity, then sensor_combined; force of sensor_combined, then vehicle_acceleration; camera of
// gimbal_device_attitude_status, then mount_orientation. A sample that says when it was measured (timestamp_sample) has
// that time. Errors as those of read_track().
[[nodiscard]] Result<Track> read_ulog(const std::filesystem::path& file, const ReadTrackOptions& options);

// The same of the bytes of a file.
[[nodiscard]] Result<Track> ulog_track(std::string_view bytes, const std::filesystem::path& file,
                                       const ReadTrackOptions& options = {});

}  // namespace sigs
