// SPDX-License-Identifier: MIT
#include "first_project/first_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/pose.h"
#include "base/text.h"
#include "camera/calibration_text.h"
#include "scene/camera_track.h"
#include "scene/scene_at.h"
#include "telemetry/gpmf.h"
#include "telemetry/track.h"

namespace sigs {

namespace {

constexpr double kMinFov_deg = 1;
constexpr double kMaxFov_deg = 359;
const std::string kStateFov = "--fov states it if you know it; ";
const std::string kEquirectangular = "equirectangular";  // VideoInfo::projection
const std::string kMeasure = "`sigs calibrate` measures the lens";

double pixel_aspect(const VideoInfo& video) {
  return double(video.pixel_aspect_num) / video.pixel_aspect_den;
}

// Focal length, in the unit of half_size, of an image that ends at half_size at this angle from the axis.
double focal_length(double half_size, double half_angle_rad, bool is_fisheye) {
  return is_fisheye ? half_size / half_angle_rad : half_size / std::tan(half_angle_rad);
}

// A lens without distortion, of equal angles a pixel if it is a fisheye, with its axis in the middle of the image.
//   focal  in heights of a pixel
LensParameters plain_lens(const VideoInfo& video, double focal, bool is_fisheye) {
  LensParameters lens;
  lens.model = is_fisheye ? LensModel::kannala_brandt : LensModel::brown_conrady;
  lens.fx = focal / pixel_aspect(video);
  lens.fy = focal;
  lens.cx = (video.size_px.width - 1) / 2.0;
  lens.cy = (video.size_px.height - 1) / 2.0;
  lens.coefficients.assign(is_fisheye ? 4 : 5, 0.0);
  return lens;
}

struct GuessedLens {
  LensParameters lens;
  std::string how;          // "a pinhole of 70 degrees from side to side"
  bool is_default = false;  // nothing tells it
};

// The lens of a field of view along a length of the image, in heights of a pixel.
GuessedLens lens_of(const VideoInfo& video, double length, double fov_rad, bool is_fisheye, const std::string& across) {
  GuessedLens guessed{.lens = plain_lens(video, focal_length(length / 2, fov_rad / 2, is_fisheye), is_fisheye)};
  guessed.how = fmt::format("{} of {:.4g} degrees {}", is_fisheye ? "an equidistant fisheye" : "a pinhole",
                            deg_of_rad(fov_rad), across);
  return guessed;
}

// A pinhole of that field of view along the image's longer side.
GuessedLens default_lens(const VideoInfo& video, double fov_rad) {
  const double width = video.size_px.width * pixel_aspect(video), height = video.size_px.height;
  return lens_of(video, std::max(width, height), fov_rad, false,
                 width >= height ? "from side to side" : "from top to bottom");
}

GuessedLens guessed_lens(const FirstProjectOptions& options, const VideoInfo& video,
                         const std::optional<LoggedLens>& logged, FirstProjectNote& note) {
  const double width = video.size_px.width * pixel_aspect(video);
  const double height = video.size_px.height;
  const auto finish = [&](GuessedLens guessed, const std::string& why) {
    note.text = guessed.how + ", " + why;
    return guessed;
  };
  note.is_guess = true;
  note.remedy = kMeasure;
  if (options.horizontal_fov_deg) {
    const double fov_deg = *options.horizontal_fov_deg;
    return finish(lens_of(video, width, rad_of_deg(fov_deg), fov_deg >= kFisheyeFov_deg, "from side to side"),
                  "as asked for; distortion is not known");
  }
  if (logged && logged->diagonal_fov_rad && *logged->diagonal_fov_rad < rad_of_deg(kMaxFov_deg)) {
    const bool is_fisheye = logged->is_fisheye || *logged->diagonal_fov_rad >= rad_of_deg(kFisheyeFov_deg);
    return finish(
        lens_of(video, std::hypot(width, height), *logged->diagonal_fov_rad, is_fisheye, "along the diagonal"),
        "by what the file states (" + logged->source + "); distortion is not known");
  }
  if (logged && logged->horizontal_fov_rad && *logged->horizontal_fov_rad < rad_of_deg(kMaxFov_deg)) {
    const bool is_fisheye = logged->is_fisheye || *logged->horizontal_fov_rad >= rad_of_deg(kFisheyeFov_deg);
    return finish(lens_of(video, width, *logged->horizontal_fov_rad, is_fisheye, "from side to side"),
                  "by what the file states (" + logged->source + "); distortion is not known");
  }
  note.remedy = kStateFov + note.remedy;
  if (video.size_px.width == 2 * video.size_px.height)
    note.remedy +=
        "; if the image, twice as wide as high, is 360 degree footage, set footage.lens_model to "
        "equirectangular and footage.calibration to \"\"";
  GuessedLens guessed = default_lens(video, rad_of_deg(kGuessedFov_deg));
  guessed.is_default = true;
  return finish(std::move(guessed), "a guess: nothing in the file tells it");
}

FirstCamera camera_of(const VideoInfo& video, const GuessedLens& guessed, Lens lens, FirstProjectNote note) {
  std::string text = calibration_xml(
      {.lens = guessed.lens, .size_px = video.size_px, .comment = "Not measured: " + note.text + ".", .numbers = {}});
  return {.camera = {.lens = std::move(lens), .size_px = video.size_px},
          .calibration_text = std::move(text),
          .note = std::move(note),
          .is_default = guessed.is_default};
}

}  // namespace

Result<FirstCamera> first_camera(const FirstProjectOptions& options, const VideoInfo& video,
                                 const std::optional<LoggedLens>& logged) {
  FirstProjectNote note{.field = "footage.calibration"};
  if (!options.calibration.empty()) {
    Result<Camera> camera = read_calibration(options.calibration, video.size_px);
    if (!camera) return fail(camera.error());
    note.text = options.calibration.filename().string() + ", as given";
    return FirstCamera{.camera = *std::move(camera), .note = note};
  }
  if (!options.horizontal_fov_deg && video.projection == kEquirectangular) {
    note.field = "footage.lens_model";
    note.text = "equirectangular: the file states 360 degree footage";
    return FirstCamera{.camera = equirectangular_camera(video.size_px), .note = note};
  }
  if (options.horizontal_fov_deg &&
      !(*options.horizontal_fov_deg >= kMinFov_deg && *options.horizontal_fov_deg <= kMaxFov_deg))
    return fail("horizontal field of view", fmt::format("must be {} to {} degrees", kMinFov_deg, kMaxFov_deg),
                ErrorKind::usage);
  const GuessedLens guessed = guessed_lens(options, video, logged, note);
  Result<Lens> lens = Lens::make(guessed.lens);
  if (!lens) return fail(lens.error());
  return camera_of(video, guessed, *std::move(lens), std::move(note));
}

Result<FirstCamera> camera_by_turns(const VideoInfo& video, const FocalScale& seen) {
  const auto field_rad = [](double scale) { return 2 * std::atan(std::tan(rad_of_deg(kGuessedFov_deg) / 2) / scale); };
  const GuessedLens guessed = default_lens(video, field_rad(seen.value));
  FirstProjectNote note{.field = "footage.calibration", .is_guess = true};
  note.text = fmt::format("{}, by how {} ({} {:.0f}); distortion is not known", guessed.how,
                          seen.by_gyro ? "fast the images turn beside the log's gyroscope" : "the images turn",
                          seen.largest > 0 ? fmt::format("{:.0f} to", deg_of_rad(field_rad(seen.largest))) : "at most",
                          deg_of_rad(field_rad(seen.least)));
  note.remedy = kStateFov + kMeasure;
  Result<Lens> lens = Lens::make(guessed.lens);
  if (!lens) return fail(lens.error());
  return camera_of(video, guessed, *std::move(lens), std::move(note));
}

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
  Result<CameraFlight, Problem> flight = flight_by_log(project, track, footage, range);
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
    Result<Track> track = read_track(candidate, cancel);
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
