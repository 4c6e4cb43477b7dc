// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "telemetry/track.h"

namespace sigs {

// What a track contains, channel by channel, and what is odd about its times.

struct Gap {
  double at_s = 0;      // the last sample before it
  double length_s = 0;  // to the next one
};

// A place where a channel's own clock does not go on as the track's time does.
struct ClockJump {
  double at_s = 0;    // on the track's time axis, of the sample after it
  double jump_s = 0;  // own clock minus track time, change
  std::string what;   // "goes back", "goes back by 2^32 ms: a 32-bit count began again", "goes ahead"
};

struct Range {
  std::string column;  // name and unit as in track_csv.h: "height_m"
  double low = 0;
  double high = 0;
};

struct ChannelReport {
  std::string name;  // the member of Track: "camera_rate_radps"
  std::string source;
  std::string clock;
  int count = 0;
  double first_s = 0;
  double last_s = 0;
  double median_rate_hz = 0;          // 0: fewer than two instants
  std::vector<Gap> gaps = {};         // longer than kGapFactor median intervals; all of them
  std::vector<ClockJump> jumps = {};  // of own_times_s; all of them
  int repeated = 0;                   // samples at the same time as the one before
  std::vector<Range> ranges = {};     // of the values
};
inline constexpr double kGapFactor = 2.5;

// The channels that are not empty, in the order of track.h.
[[nodiscard]] std::vector<ChannelReport> track_report(const Track& track);

// The report as a table for people, with a line feed at its end. The track's warnings are not in it.
//   most_gaps  number of gaps and jumps of a channel that are listed; of the others the number is said
[[nodiscard]] std::string track_report_text(const Track& track, int most_gaps = 5);

// What a track has, on one line: "position (GPMF GPS5), angular rates of the camera (GPMF GYRO)".
[[nodiscard]] std::string contents_text(const Track& track);

// Drawings of a track over time, one below the other, of what it has: roll, pitch and yaw of the airframe and of the
// camera in degrees, angular rates in degrees per second, height or depth, and the ground track from above in metres
// (north up, both axes to the same scale). BGR, 8 bits. Empty: there is nothing of these in the track.
[[nodiscard]] cv::Mat track_plot(const Track& track);

}  // namespace sigs
