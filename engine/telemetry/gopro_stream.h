// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "telemetry/gpmf.h"
#include "telemetry/track.h"
#include "video/data_streams.h"

#include <glm/glm.hpp>

namespace sigs {

// The streams of a GoPro's telemetry (GPMF DEVC / STRM) over all payloads, and the times of their samples.

// What one payload has of one stream.
struct GoproBlock {
  double time_s = 0;      // of the payload on the footage's time axis
  double duration_s = 0;  // 0: not known
  int first_row = 0;
  int rows = 0;
  double first_index = 0;              // number of samples of the stream before it, since the recording began (TSMP)
  std::optional<double> stamp_s = {};  // STMP: of its first sample, on the camera's clock
  double delay_s = 0;                  // TIMO: the samples are older by it
  std::optional<double> fix = {};      // GPSF: 0 none, 2, 3
  std::string utc = {};                // GPSU: yymmddhhmmss.sss
};

// One stream of one device. Values are scaled (SCAL), in the units and the column order of the file.
struct GoproStream {
  std::string key;             // of its samples: "GYRO"
  std::string device;          // DVNM: "Camera", "HERO9 Black", "GoPro Karma v1.0"
  std::string name;            // STNM: "Gyroscope (z,x,y)"
  std::string axes_in;         // ORIN: "ZXY", "yXz"; the stored columns in GoPro's axes, small: reversed
  std::string axes_out;        // ORIO: of what MTRX gives
  std::string height_of;       // GPSA: "MSLV"
  std::vector<double> matrix;  // MTRX: 9 numbers, row by row
  GpmfNumbers samples;
  std::vector<GoproBlock> blocks;  // in the order of the file; those without samples are left out
};

struct GoproStreams {
  std::vector<GoproStream> streams;   // those whose keys were asked for, by device and key, in order of appearance
  std::map<std::string, int> unused;  // other keys, by their names, and in how many payloads they are
  std::vector<std::string> devices;
  std::vector<std::pair<std::string, double>> broken;  // payloads with damage: what is wrong, and their times
};

// Reads the streams of these keys from all payloads. What is broken in one payload ends the reading of that payload.
[[nodiscard]] GoproStreams gopro_streams(const std::vector<DataPacket>& payloads, const std::vector<std::string>& keys);

// The times of a stream's samples.
struct GoproTimes {
  std::vector<double> times_s;      // on the footage's time axis, not falling
  std::vector<double> own_times_s;  // with STMP only: on the camera's clock
  double residual_s = 0;            // root mean square of what the payloads' times differ from the fit
  bool is_fit = false;              // false: spread evenly within each payload alone
};

// Samples come at an even rate, but payloads are cut when a buffer is flushed, so their numbers of samples vary. A
// straight line of payload times over sample numbers (TSMP) is fitted, which averages the jitter; payloads off by more
// than three times the median are left out, as the first often is. With fewer than three payloads, or where no line
// fits within kMaxResidual_s, the samples of each payload are spread evenly over it.
[[nodiscard]] GoproTimes gopro_times(const GoproStream& stream);
inline constexpr double kMaxResidual_s = 0.1;

// With STMP, which must be in every block: times on the camera's clock, straight between the blocks' stamps.
//   offset_s  footage time minus camera clock
[[nodiscard]] GoproTimes gopro_stamped_times(const GoproStream& stream, double offset_s);
[[nodiscard]] bool is_stamped(const GoproStream& stream);

// The offset of a clock whose stamps the samples have themselves (`column`, seconds), against the footage: each sample
// arrived while its payload was written, so each bounds it. Over all the streams given, which share the clock.
struct ClockOffset {
  double offset_s = 0;       // footage time minus own time
  double uncertainty_s = 0;  // half of the range that the payloads allow
  bool consistent = true;    // false: they allow none; the offset is a median, the uncertainty the median deviation
};
[[nodiscard]] std::optional<ClockOffset> clock_offset(const std::vector<const GoproStream*>& streams, int column);

// Axes of a GoPro's inertial sensors. GoPro names them of the camera as it stands upright, seen from behind: X to the
// left, Y backwards (towards the photographer), Z up; right-handed. Of the HERO5 on a Karma this was checked against
// the footage: the first column of GYRO (Z) is the image's motion to the right, r = 0.998; the first of ACCL is +9.8
// m/s^2; the third (Y) is negative while the drone gains speed.
//
// Which column is which axis, by the first of these that the stream has:
//   ORIN               letters in the order of the columns, small ones reversed: "ZXY", "YxZ" (HERO7 and later)
//   MTRX with ORIO     ORIO names the axes of MTRX times the columns
//   STNM               "Gyroscope (z,x,y)", "Accelerometer (up/down, right/left, forward/back)": HERO5, Karma
//   DVNM               HERO6 and HERO7 "YxZ", Fusion "yXZ", as GoPro documents them
//   nothing            "ZXY" is assumed, as HERO5 has it
struct GoproAxes {
  glm::dmat3 camera_from_columns{1};  // camera axes X forward, Y right, Z down
  std::string from;                   // "ORIN ZXY", "the name of the stream"
  bool assumed = false;               // nothing in the file says so
};
[[nodiscard]] GoproAxes gopro_axes(const GoproStream& stream);

// Fills ned_from_camera of a GoPro's track with how its images turned, from start_from_camera (CORI), camera_from_image
// (IORI) and camera_gravity (GRAV): CORI * IORI, the camera's turn since the start and then that of the stabilisation.
// Level is where GRAV, turned back to the start by CORI, points in the mean over the clip; without GRAV, or with a
// warning where the two are apart by more than 5 degrees in the median, attitudes are against the first sample
// (level_is_known). Yaw counts from the first sample. Nothing is done without CORI, or where an airframe's attitude,
// against north, is there.
void join_camera_attitude(Track& track);

}  // namespace sigs
