// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "telemetry/track.h"

namespace sigs {

// A flight log as comma-separated values with named columns: one row for each instant, an empty cell where a channel
// has no sample at it. The columns may stand in any order, small or capital; those of a channel go together.
//
// clang-format off
//   time_s                                            of the row, on the track's time axis; not falling. Or
//   frame                                             its frame number; then the line `# frame_rate: 30000/1001` must be there
//   latitude_deg longitude_deg height_m               position
//   north_m east_m down_m                             local_position_ned_m
//   vn_mps ve_mps vd_mps                              velocity_ned_mps
//   roll_deg pitch_deg yaw_deg                        ned_from_airframe
//   camera_roll_deg camera_pitch_deg camera_yaw_deg   ned_from_camera
//   camera_sd_x_deg camera_sd_y_deg camera_sd_z_deg   camera_attitude_sd_rad, about the camera's axes
//   start_camera_qw start_camera_qx ... qz            start_from_camera
//   camera_image_qw camera_image_qx ... qz            camera_from_image
//   camera_rate_x_radps ... z                         camera_rate_radps; airframe_rate_x_radps ...: airframe_rate_radps
//   camera_force_x_mps2 ... z                         camera_force_mps2; airframe_force_x_mps2 ...: airframe_force_mps2
//   camera_gravity_x ... z                            camera_gravity
//   exposure_s                                        exposure_s
//   white_cdpm2                                       white_cdpm2
//   NAME_own_s                                        own_times_s of the channel NAME of track.h, as position_own_s
// clang-format on
//
// Also read, of files by others: time, t, t_s, timestamp_s; lat, lat_deg, latitude; lon, lng, lon_deg, long, longitude;
// alt, alt_m, altitude, altitude_m, height; roll, pitch, yaw, heading, heading_deg (degrees); vn, ve, vd.
//
// Lines that begin with # before the columns are settings, `# key: value`, of which other programs see comments:
// format, device, on_footage_time (true, false), utc_at_zero_s, heading_is_north, level_is_known, attitude_is_whole,
// height_above_ellipsoid, readout_s, damaged, frame_rate, warning (any number of them), source NAME and clock NAME of a
// channel. Unknown ones are comments.

// The track as such a file. read_track() gives the same track back: numbers lose no digit, attitudes some 1e-15 by the
// conversion to degrees (1e-8 straight up and down). Samples of one channel at the same time stand in rows of their
// own.
[[nodiscard]] std::string track_csv_text(const Track& track);

// Whether a file that begins so is one: its first line that is no comment names a time and at least one of a channel's
// columns.
[[nodiscard]] bool is_track_csv(std::string_view head);

// Reads its text. Cells that are no numbers, rows whose time does not go with those around them (StampedValues), and
// columns that are not known are left out with a warning. A channel without all of its columns is left out with a
// warning; height_m may be missing, it is 0 then. Errors as those of read_track().
//   file    for the messages
//   cancel  as that of read_track()
[[nodiscard]] Result<Track> track_of_csv(std::string_view text, const std::filesystem::path& file,
                                         const std::atomic<bool>* cancel = nullptr);

// How a channel's values stand in the columns of track_csv.h: the names of the columns, and values as numbers and back.

// Names of the columns of a channel, in order; the channel by its name as for_each_channel() gives it.
[[nodiscard]] std::vector<std::string> csv_columns(std::string_view channel);

// The column name of ours for one that others use, "lat" -> "latitude_deg"; the same name in small letters otherwise.
[[nodiscard]] std::string csv_column_name(std::string_view name);

// A value as the numbers of its columns.
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, const GeodeticPosition& value);
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, const glm::dvec3& value);
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, const glm::dquat& value);
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, double value);

// And back. `numbers` has as many as there are columns, all finite. False: they are no such value (a place beyond the
// poles, a quaternion of length 0).
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, GeodeticPosition& value);
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, glm::dvec3& value);
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, glm::dquat& value);
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, double& value);

}  // namespace sigs
