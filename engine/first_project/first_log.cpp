// SPDX-License-Identifier: MIT
#include "first_project/first_log.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>
#include <utility>

#include "base/pose.h"
#include "base/text.h"
#include "scene/camera_track.h"
#include "scene/scene_at.h"
#include "telemetry/gopro_header.h"
#include "telemetry/read_track.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

const std::string kEgoMotion = "`sigs ego-motion --into` finds in the images how the camera turns";
constexpr double kMinSpeed_mps = 2;  // slower ones are hidden in the error of satellite positions
constexpr double kMaxSpeed_mps = 300;

// A project that follows the log, and what comes of it.
struct Followed {
  Project project;
  CameraFlight flight;
};

std::optional<Followed> followed(Project project, const Track& track, TrackPositionChoice position,
                                 TrackAttitudeChoice attitude, const FootageShape& footage, const FrameRange& range,
                                 std::string& why_not) {
  project.camera.track.position = position;
  project.camera.track.attitude = attitude;
  OrProblem<CameraFlight> flight = flight_by_log(project, track, footage, range);
  if (flight) return Followed{std::move(project), *std::move(flight)};
  why_not = flight.error().what;
  return std::nullopt;
}

double mean_speed_mps(const CameraFlight& flight, const FootageShape& footage, const FrameRange& range) {
  const double first_s = time_of_frame_s(footage, range.first);
  const double last_s = time_of_frame_s(footage, range.last);
  if (!(last_s > first_s)) return 0;
  const glm::dvec3 way_m =
      camera_at(flight.motion, last_s).translation_m - camera_at(flight.motion, first_s).translation_m;
  return glm::length(way_m) / (last_s - first_s);
}

}  // namespace

Result<FirstLog> log_of_video(const fs::path& video, const std::atomic<bool>* cancel) {
  FirstLog log;
  std::vector<fs::path> candidates{video};
  for (const char* const extension : {".srt", ".SRT"})
    candidates.push_back(fs::path(video).replace_extension(extension));
  for (const fs::path& candidate : candidates) {
    std::error_code code;
    if (log.track || !fs::is_regular_file(candidate, code)) continue;
    Result<Track> track = read_track(candidate, {.cancel = cancel});
    if (!track && track.error().kind == ErrorKind::interrupted) return fail(track.error());
    if (!track) {
      if (log.unusable.empty() && carries_telemetry(candidate))
        log.unusable = candidate.filename().string() + " " + track.error().what;
      continue;
    }
    log.file = candidate;
    log.lens = track->lens;
    log.track = std::make_shared<const Track>(*std::move(track));
  }
  if (const std::optional<GoproHeader> header = read_gopro_header(video); header && header->lens())
    log.lens = header->lens();
  return log;
}

std::vector<FirstProjectNote> set_track(const FirstLog& log, const std::string& log_path, const FootageShape& footage,
                                        const FrameRange& range, Project& project) {
  FirstProjectNote note{.field = "camera.track.file"};
  const auto unused = [&](const std::string& why) {
    note.text = fmt::format("none: {}, {}, is not used: {}; the camera stands still", log.file.filename().string(),
                            log.track->format, why);
    note.remedy = kEgoMotion;
    note.is_guess = true;
    return std::vector{note};
  };
  if (!log.track) {
    FirstProjectNote still{.field = "camera.speed_mps", .is_guess = true, .remedy = kEgoMotion};
    still.text = fmt::format(
        "0: {}, so the intruder's motion is that against the camera",
        log.unusable.empty() ? "no flight log tells how the camera moves" : "there is telemetry, but " + log.unusable);
    return {still};
  }
  const Track& track = *log.track;
  if (!track.on_footage_time) return unused("its time of the footage's frame 0 is not known (camera.track.offset_s)");
  if (track.damaged) return unused("it is damaged");
  Project wanted = project;
  wanted.camera.track.file = log_path;
  const bool has_camera = !track.ned_from_camera.empty();
  const TrackAttitudeChoice attitude = has_camera ? TrackAttitudeChoice::camera : TrackAttitudeChoice::none;
  std::string why_not = "it has neither positions nor an attitude of the camera";
  std::optional<Followed> used;
  if (!track.position.empty() || !track.local_position_ned_m.empty()) {
    used = followed(wanted, track, TrackPositionChoice::automatic, attitude, footage, range, why_not);
    const double speed_mps = used ? mean_speed_mps(used->flight, footage, range) : 0;
    if (used && !(speed_mps >= kMinSpeed_mps && speed_mps <= kMaxSpeed_mps)) {
      why_not = fmt::format("by its positions the camera moves at {:.1f} m/s", speed_mps);
      used.reset();
    }
  }
  if (!used && has_camera) used = followed(wanted, track, TrackPositionChoice::none, attitude, footage, range, why_not);
  if (!used) return unused(why_not);
  project = used->project;
  const bool has_path = used->flight.motion.path != nullptr;
  note.text = fmt::format("{}, {}: the camera follows its {}", log.file.filename().string(), track.format,
                          has_path && has_camera ? "path and attitude"
                          : has_path             ? "path; it has no attitude of the camera"
                                                 : "attitude");
  std::vector<FirstProjectNote> notes{note};
  if (has_path && (!has_camera || !track.heading_is_north) && used->flight.earth) {
    project.geo.heading_deg = std::round(10 * deg_of_rad(used->flight.earth->heading_rad())) / 10;
    notes.push_back({.field = "geo.heading_deg",
                     .text = fmt::format("{} degrees, the course over ground: the log does not know where the camera "
                                         "looks",
                                         number_text(*project.geo.heading_deg, 1)),
                     .is_guess = true});
  }
  return notes;
}

bool lacks_attitude(const FirstLog& log, const Project& project) {
  return project.camera.track.file.empty() || !log.track || log.track->ned_from_camera.empty();
}

}  // namespace sigs
