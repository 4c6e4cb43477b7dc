// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "ego_motion/ego_motion.h"
#include "first_project/first_project.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

// The horizontal or, of a portrait image, vertical field of view that is taken where nothing is known, degrees: between
// those of phones and drones (65 to 75) and the linear modes of action cameras (70 to 90).
inline constexpr double kGuessedFov_deg = 70;

// From this field of view on a lens is taken for a fisheye with equal angles a pixel; no pinhole camera is so wide.
inline constexpr double kFisheyeFov_deg = 120;

// The lens of a first project.
struct FirstCamera {
  Camera camera;                 // of the footage's size
  std::string calibration_text;  // of the file to be written; empty: the user's file is used, or none is needed
  FirstProjectNote note;         // field footage.calibration
  bool is_default = false;       // of kGuessedFov_deg, since nothing tells it
};

// The camera of the user's calibration file, else of the stated field of view, else of what the file says, else of
// kGuessedFov_deg. Footage whose container states it equirectangular has that lens, which needs no file. Pixels that
// are not square are respected.
//   logged  what the footage's file or its log says; may be nothing
// Errors: those of read_calibration(); usage for a field of view out of range.
[[nodiscard]] Result<FirstCamera> first_camera(const FirstProjectOptions& options, const VideoInfo& video,
                                               const std::optional<LoggedLens>& logged);

// The camera of kGuessedFov_deg with the focal length that the turns of the images show instead.
[[nodiscard]] Result<FirstCamera> camera_by_turns(const VideoInfo& video, const FocalScale& seen);

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
