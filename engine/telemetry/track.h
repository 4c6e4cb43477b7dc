// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "geo/geodetic.h"

namespace sigs {

// One quantity over time, as a log has it. Each channel has its own instants; an empty one is not in the log.
template <class T>
struct Channel {
  std::string source;                // its name in the file: "GPMF GYRO", "vehicle_attitude", "F.PRY"; empty: not there
  std::vector<double> times_s = {};  // on the track's time axis (Track), not falling
  std::vector<T> values = {};        // one for each time; finite
  std::vector<double> own_times_s = {};  // the stamps that the file has, in seconds of the channel's own clock, one for
                                         // each value; empty: the file has none, times_s are derived (see `clock`)
  std::string clock = {};  // what the times come from: "footage", "time since boot", "UTC", "frame number"

  [[nodiscard]] bool empty() const { return values.empty(); }
};

// The field of view that a log states of the camera: one of the two angles. It is the maker's figure, rounded, of the
// whole image.
struct LoggedLens {
  std::string source;                             // "focal_len, 24 mm before a sensor 36 mm wide"
  std::optional<double> horizontal_fov_rad = {};  // across the image
  std::optional<double> diagonal_fov_rad = {};    // from corner to corner
  bool is_fisheye = false;                        // the image is not that of a pinhole: straight lines are curved
};

// A flight as a log tells it, in neutral units and axes, whatever the format. NED: north, east, down, tangent to the
// ellipsoid at the place. Camera and airframe axes: X forward (along the optical axis, out of the nose), Y right, Z
// down (docs/frames-and-units.md).
//
// Time axis: of logs inside a video, and of subtitles, the footage's own: 0 is the presentation time of its frame 0.
// Of all others seconds since the first stamp of the file.
struct Track {
  std::filesystem::path file;
  std::string format;  // "GoPro GPMF", "DJI subtitles", "PX4 ULog", "ArduPilot dataflash", "MISB ST 0601", "CSV"
  std::string device;  // as the file names it; empty: it does not
  bool on_footage_time = false;              // the time axis is the footage's
  std::optional<double> utc_at_zero_s = {};  // UTC of time 0, seconds since 1970 without leap seconds
  bool heading_is_north = true;              // false: yaw 0 is an arbitrary heading, as that of a camera alone
  bool level_is_known = true;                // false: the camera's attitude is against that of its first sample
  bool attitude_is_whole = false;            // ned_from_camera is the camera's own, with nothing mounted on it

  Channel<GeodeticPosition> position = {};
  bool height_above_ellipsoid = false;            // false: above the sea, above the start or not known; see warnings
  Channel<glm::dvec3> local_position_ned_m = {};  // from an origin of the log's own
  Channel<glm::dvec3> velocity_ned_mps = {};
  Channel<glm::dquat> ned_from_airframe = {};       // attitude of the aircraft
  Channel<glm::dquat> ned_from_camera = {};         // attitude of the gimbal or camera; of images that the camera
                                                    // stabilised that of the images
  Channel<glm::dvec3> camera_attitude_sd_rad = {};  // standard deviation of ned_from_camera: small turns about the
                                                    // camera's X, Y and Z
  Channel<glm::dquat> start_from_camera = {};       // camera against its own attitude at the start (GPMF CORI)
  Channel<glm::dquat> camera_from_image = {};       // what in-camera stabilisation turned the image by (GPMF IORI)
  Channel<glm::dvec3> camera_rate_radps = {};       // angular rate about the camera's axes
  Channel<glm::dvec3> airframe_rate_radps = {};
  Channel<glm::dvec3> camera_force_mps2 = {};  // specific force (what an accelerometer measures) along camera axes
  Channel<glm::dvec3> airframe_force_mps2 = {};
  Channel<glm::dvec3> camera_gravity = {};  // unit vector downwards in camera axes (GPMF GRAV)
  Channel<double> exposure_s = {};
  Channel<double> white_cdpm2 = {};      // luminance that the exposure shows as white, without any filter
  std::optional<LoggedLens> lens = {};   // at its first sample
  std::optional<double> readout_s = {};  // of the rolling shutter, first to last row

  // What is wrong or doubtful, each with its channel and time: GPS without fix, places at 0/0, jumps of the clock,
  // gaps, samples that were left out. Samples that a warning names as unsound are not in the channels.
  std::vector<Warning> warnings = {};
  std::vector<std::string> unused_streams = {};  // by their names in the file: they are there, nothing is made of them
  bool damaged = false;                          // the file is cut off or broken: what stands before the damage is here
};

// Calls visit(name, channel) for each channel of a track, in the order of Track, those that are empty too. The name
// is the member's: "camera_rate_radps".
//   TrackType  Track or const Track
template <class TrackType, class Visit>
void for_each_channel(TrackType& track, const Visit& visit) {
  visit("position", track.position);
  visit("local_position_ned_m", track.local_position_ned_m);
  visit("velocity_ned_mps", track.velocity_ned_mps);
  visit("ned_from_airframe", track.ned_from_airframe);
  visit("ned_from_camera", track.ned_from_camera);
  visit("camera_attitude_sd_rad", track.camera_attitude_sd_rad);
  visit("start_from_camera", track.start_from_camera);
  visit("camera_from_image", track.camera_from_image);
  visit("camera_rate_radps", track.camera_rate_radps);
  visit("airframe_rate_radps", track.airframe_rate_radps);
  visit("camera_force_mps2", track.camera_force_mps2);
  visit("airframe_force_mps2", track.airframe_force_mps2);
  visit("camera_gravity", track.camera_gravity);
  visit("exposure_s", track.exposure_s);
  visit("white_cdpm2", track.white_cdpm2);
}

// Reads a flight log; the format is recognised by the content, not by the name: a video with GoPro GPMF, DJI subtitles
// or MISB KLV in it, DJI .srt, PX4 ULog, ArduPilot dataflash, a bare KLV stream, CSV with named columns.
// A damaged file gives what stands before the damage, with `damaged` set and a warning that says where.
//   cancel  set to true: ends soon with the error `interrupted`
// Errors: cannot_read, bad_data (no known format, no telemetry in it, or nothing sound), interrupted.
[[nodiscard]] Result<Track> read_track(const std::filesystem::path& file, const std::atomic<bool>* cancel = nullptr);

// Whether one of these formats recognises the file or a stream in it, though nothing in it may be sound.
[[nodiscard]] bool carries_telemetry(const std::filesystem::path& file);

}  // namespace sigs
