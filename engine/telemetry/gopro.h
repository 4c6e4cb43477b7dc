// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "telemetry/read_track.h"
#include "telemetry/track.h"
#include "video/data_streams.h"

namespace sigs {

// GoPro's telemetry in a video: GPMF (gpmf.h, gopro_stream.h, gopro_axes.h).
//
//   GYRO, ACCL        camera_rate_radps, camera_force_mps2
//   CORI, IORI, GRAV  start_from_camera, camera_from_image, camera_gravity. Quaternions are stored as w, X, Z, Y, and
//                     gravity as X, -Z, -Y of GoPro's axes. The sign of gravity is that which opposes ACCL; where there
//                     is no ACCL it is taken as stored.
//   SHUT              exposure_s
//   SROT              readout_s
//   GPS5, GPS9        position, without samples that have no fix or lie at 0/0; GPSU or GPS9: utc_at_zero_s
//   ATTD, LNED, GLPI  of a Karma drone: ned_from_airframe and airframe_rate_radps, local_position_ned_m and
//                     velocity_ned_mps, position (in place of GPS5). They have the drone's own stamps, which are placed
//                     on the footage's axis by the payloads in which they arrived (clock_offset()). SYST: utc_at_zero_s
//
// Times of all others: gopro_times(), or with STMP in every payload the camera's stamps, of which those of the streams
// with one sample a frame begin at the time of their first payload.

// Whether a stream of a container is GoPro's telemetry.
[[nodiscard]] bool is_gopro(const DataStream& stream);

// Reads it. Errors as those of read_track().
[[nodiscard]] Result<Track> read_gopro(const std::filesystem::path& file, const DataStream& stream,
                                       const ReadTrackOptions& options);

// The same from payloads that were read already. Warnings name the file.
[[nodiscard]] Result<Track> track_of_gopro(const std::filesystem::path& file, const DataPackets& payloads);

}  // namespace sigs
