// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// What a video file has beside its images that tells when they were taken: sound, time code, the recorder's date.

// Sound in mono, equal samples in time. Each is the mean over its interval, of all channels.
struct Sound {
  double rate_hz = 8000;
  double first_s = 0;          // middle of sample 0 on the footage's time axis: 0 is the presentation time of frame 0
  std::vector<float> samples;  // -1 to 1; 0 where the file has a gap
};

// The sound of a file's first audio stream, at most of its first 1200 s. Nothing where there is none, or none that can
// be decoded.
//   cancel  while it is true, reading soon ends with the error interrupted; null, or outlives the call
// Errors: cannot_read (missing, not a regular file, no container), interrupted.
[[nodiscard]] Result<std::optional<Sound>> read_sound(const std::filesystem::path& file,
                                                      const std::atomic<bool>* cancel = nullptr);

// A time of the day as SMPTE ST 12-1 counts it: frames by number.
struct TimeCode {
  int hours = 0;
  int minutes = 0;
  int whole_seconds = 0;  // of the minute
  int frames = 0;
  bool drops_frames = false;  // numbers 0 and 1 (of 59.94 a second 0 to 3) are left out in all minutes but each tenth
  int rate_num = 25;          // frames a second of the video that it counts
  int rate_den = 1;

  // Frames since 00:00:00:00 by its own count, over the true frame rate: seconds of the day, but for codes of 29.97
  // frames a second that drop none, whose hours are 3.6 s too long.
  [[nodiscard]] double seconds() const;

  [[nodiscard]] bool operator==(const TimeCode&) const = default;
};

// The time code in a text, "10:00:00:12", or with ; or . before the frames where numbers are dropped. None: no such
// text, a number out of its range, or one that is dropped.
//   rate_num, rate_den  of the video, both positive
[[nodiscard]] std::optional<TimeCode> time_code_of(const std::string& text, int rate_num, int rate_den);

struct RecordingTime {
  std::optional<TimeCode> time_code;  // of frame 0
  std::string created;                // creation_time as the file has it: "2017-04-17T19:27:57.000000Z"; empty: none
};

// From the tags of the video stream, else of the others, else of the container. Errors as those of read_sound().
[[nodiscard]] Result<RecordingTime> recording_time_of(const std::filesystem::path& file,
                                                      const std::atomic<bool>* cancel = nullptr);

}  // namespace sigs
