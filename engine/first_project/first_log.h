// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "first_project/first_project.h"
#include "telemetry/track.h"

namespace sigs {

// A flight log that belongs to a video.
struct FirstLog {
  std::filesystem::path file;  // the video itself, or the subtitles beside it; empty: there is none
  std::shared_ptr<const Track> track;
  std::string unusable;            // "clip.ts: why": telemetry that is there, of which nothing can be read; "": none
  std::optional<LoggedLens> lens;  // by the log, or by the header of the video; also without a log
};

// Looks for a log in the video, then for DJI's subtitles beside it: of the same name with the extension .srt or .SRT.
// What has telemetry that cannot be read is named in `unusable`. Error: interrupted.
[[nodiscard]] Result<FirstLog> log_of_video(const std::filesystem::path& video, const std::atomic<bool>* cancel);

// Lets the project's camera follow the log (camera.track, geo.heading_deg), where it is good enough for that: its times
// are the footage's, it covers the frames used, it has the camera's own attitude, or positions over which the camera
// moves at 2 to 300 m/s. The notes say what is used, or why nothing is.
//   log_path  of the log as the project is to name it
//   range     frames that the project uses
[[nodiscard]] std::vector<FirstProjectNote> set_track(const FirstLog& log, const std::string& log_path,
                                                      const FootageShape& footage, const FrameRange& range,
                                                      Project& project);

// Whether the project's camera follows a log that has no attitude of its own, so that the images have to tell it.
[[nodiscard]] bool lacks_attitude(const FirstLog& log, const Project& project);

}  // namespace sigs
