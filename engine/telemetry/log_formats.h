// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "telemetry/klv_packets.h"
#include "telemetry/track.h"
#include "video/data_streams.h"

namespace sigs {

// The readers of read_track(), one group of functions for each format of a flight log: whether a file or a stream of a
// video has it, and its track. CSV: track_csv.h.

// ArduPilot's dataflash logs (.bin; https://ardupilot.org/copter/docs/logmessages.html).

// Whether a file that begins so is one.
[[nodiscard]] bool is_dataflash(std::string_view head);

// Reads the bytes of the file. Time 0 is the first stamp of a message that is read. Where several messages have a
// quantity, the first that has sound samples is taken: position of POS, GPS, AHR2 (heights above the mean sea);
// attitude of ATT, XKF1, NKF1, AHR2; velocity and local position of XKF1, NKF1, and velocity of GPS; rates and forces
// of IMU; camera of MNT. Of sensors and filters with several instances, the first one (0). UTC is that of the first GPS
// message with a three-dimensional fix, less the leap seconds of its date. Errors as those of read_track().
[[nodiscard]] Result<Track> dataflash_track(std::string_view bytes, const std::filesystem::path& file);

// PX4's logs (https://docs.px4.io/main/en/dev_log/ulog_file_format); the topics are those of PX4's msg folder.

// Whether a file that begins so is a ULog.
[[nodiscard]] bool is_ulog(std::string_view head);

// Reads the bytes of the file. Time 0 is the file's own stamp, the start of logging. Where several topics have a
// quantity, the first that has sound samples is taken: position of vehicle_global_position, vehicle_gps_position,
// sensor_gps, and last of vehicle_local_position with its reference; velocity of vehicle_local_position, then of the
// receiver; rates of vehicle_angular_velocity, then sensor_combined; force of sensor_combined, then
// vehicle_acceleration; camera of gimbal_device_attitude_status, then mount_orientation. A sample that says when it was
// measured (timestamp_sample) has that time. Errors as those of read_track().
[[nodiscard]] Result<Track> ulog_track(std::string_view bytes, const std::filesystem::path& file);

// GoPro's telemetry in a video: GPMF (gpmf.h, gopro_stream.h).
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

// Reads its payloads. Warnings name the file. Errors as those of read_track().
[[nodiscard]] Result<Track> track_of_gopro(const std::filesystem::path& file, const DataPackets& payloads);

// The subtitles in which drones by DJI write their flight, as a file (.srt) or a stream of the video.

// Whether a file that begins so has them, or is one that has a subtitle's number and nothing else. Whether a stream of
// a container may have them.
[[nodiscard]] bool is_dji_subtitles(std::string_view head);
[[nodiscard]] bool is_dji_subtitle_stream(const DataStream& stream);

// Reads them. Times are those at which the subtitles are shown. Where they have none, they are the dates', with the
// first at 0. Dates are local time, so UTC is not known; own_times_s has them as if they were UTC. Of several heights
// the first is taken that the first place has: absolute (abs_alt), of an unknown zero (altitude), above the start
// (rel_alt, BAROMETER, Hb, H). Errors as those of read_track().
[[nodiscard]] Result<Track> dji_subtitles_track(std::string_view text, const std::filesystem::path& file);
[[nodiscard]] Result<Track> dji_stream_track(const std::filesystem::path& file, const DataStream& stream,
                                             const DataPackets& payloads);

// MISB ST 0601 metadata, in a stream of an MPEG transport stream or bare in a file.

// Whether a stream of a container is KLV; whether a file that begins so is bare KLV.
[[nodiscard]] bool is_klv_stream(const DataStream& stream);
[[nodiscard]] bool is_klv(std::string_view head);

// Reads it. In a stream whose packets have presentation times (synchronous KLV), these are the times; else the time is
// that of the packets' own precision time stamp from the first on, with UTC, and a warning that the footage's frame 0
// has to be found. The camera's attitude is the platform's times the sensor's against the platform, each yaw, then
// pitch, then roll; a packet without one of the six angles has no camera attitude. The height is that above the
// ellipsoid where every packet with a place has it, else that above the mean sea. Errors as those of read_track().
[[nodiscard]] Result<Track> klv_stream_track(const std::filesystem::path& file, const DataPackets& payloads);
[[nodiscard]] Result<Track> klv_file_track(std::string_view bytes, const std::filesystem::path& file);

// A packet, and the time at which the container says that it is presented, if it does.
struct TimedKlvPacket {
  KlvPacket packet;
  std::optional<double> footage_s = {};
};

// The track of packets in the order of the file.
[[nodiscard]] Result<Track> klv_track(const std::vector<TimedKlvPacket>& packets, const std::filesystem::path& file);

}  // namespace sigs
