// SPDX-License-Identifier: MIT
#include "ego_motion/project_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ego_motion/rotation_fit.h"
#include "horizon/horizon.h"
#include "scene/camera_track.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "scene/scene_files.h"
#include "scene/scene_parts.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

// Hundredths of a degree are less than a pixel and keep the numbers short.
double rounded_deg(double angle_rad) {
  return std::round(deg_of_rad(angle_rad) * 100) / 100;
}

cv::Mat bytes_of_share(const cv::Mat& share) {
  cv::Mat mask;
  if (!share.empty()) share.convertTo(mask, CV_8U, 255);
  return mask;
}

// The log with its times on the footage's axis.
Track on_footage_time(Track log, double offset_s) {
  for_each_channel(log, [&](std::string_view, auto& channel) {
    for (double& time_s : channel.times_s) time_s -= offset_s;
  });
  if (log.utc_at_zero_s) *log.utc_at_zero_s += offset_s;
  log.on_footage_time = true;
  return log;
}

// --- A motion for a project.

class Estimating {
 public:
  Estimating(const Project& project, const EgoMotionControl& control, double max_unknown_share)
      : project_(project), control_(control), max_unknown_share_(max_unknown_share) {}

  Result<ProjectMotion> run() {
    Result<FrameSource> footage = open_footage(project_, control_.cancel);
    if (!footage) return fail(footage_error(project_, footage.error()));
    for (const Warning& warning : footage->info().warnings) found_.warnings.push_back(warning);
    const FootageShape shape = footage_shape(project_, footage->info());
    const Result<Camera, Problem> camera = scene_camera(project_, shape, files_);
    if (!camera) return fail(error_of(project_, camera.error()));
    for (const Warning& warning : camera->warnings) found_.warnings.push_back(warning);
    const Result<cv::Mat, Problem> own_body = scene_own_body(project_, shape.size_px, files_);
    if (!own_body) return fail(error_of(project_, own_body.error()));
    read_log();
    note_stated_attitude(shape);
    Result<EgoMotion> motion =
        estimate_ego_motion(*footage, *camera, bytes_of_share(*own_body), log_ ? &*log_ : nullptr,
                            {.readout_s = project_.camera.readout_s}, control_);
    if (!motion) return fail(motion.error());
    if (const Result<void> known = check_known(*motion, footage->info().path.string(), max_unknown_share_); !known)
      return fail(known.error());
    found_.motion = *std::move(motion);
    make_track();
    const FoundAttitudes of_motion = found_attitudes(found_.motion, {});
    found_.found.is_complete = of_motion.is_complete;
    found_.found.level_at_start = of_motion.level_at_start;
    // Of a rig camera.attitude_deg is the first camera's where the level is known, else the aircraft's
    // (camera_flight()).
    std::optional<Attitude>& stated = found_.found.stated_at_start;
    if (stated && project_.rig_view && !of_motion.level_at_start)
      stated = attitude_of(glm::normalize(rotation_of(*stated) * glm::conjugate(mount_of_first())));
    return std::move(found_);
  }

 private:
  // With its times as the project places them, where it does.
  void read_log() {
    const TrackSettings& settings = project_.camera.track;
    if (settings.file.empty()) return;
    const Result<std::shared_ptr<const Track>> read = files_.track(resolved(project_, settings.file));
    if (!read) {
      found_.warnings.push_back({read.error().where, read.error().what});
      return;
    }
    log_ = settings.offset_s != 0 ? on_footage_time(**read, settings.offset_s) : **read;
  }

  // Of a rig's first camera, whose attitude is found; no turn where there is one camera.
  [[nodiscard]] glm::dquat mount_of_first() const {
    return project_.rig_view ? body_from_camera(project_.rig_view->reference_mount).rotation : glm::dquat(1, 0, 0, 0);
  }

  void note_stated_attitude(const FootageShape& shape) {
    const Result<FrameRange, Problem> range = scene_range(project_.footage, shape);
    if (!range) return;
    const Result<CameraFlight, Problem> flight = camera_flight(project_, shape, *range, files_);
    if (!flight || (flight->motion.attitudes.empty() && mount_of_first() == glm::dquat(1, 0, 0, 0))) return;
    found_.found.stated_at_start = attitude_of(camera_at(flight->motion, time_of_frame_s(shape, 0)).rotation);
    if (flight->earth) found_.found.heading_of_world_rad = flight->earth->heading_rad();
  }

  void make_track() {
    found_.track = track_of(found_.motion, resolved(project_, project_.footage.video));
    if (log_) {
      // What the images and a gyroscope do not place stays where the project has it.
      log_->on_footage_time = true;
      add_log(found_.track, *log_, found_.motion);
    }
    if (project_.camera.readout_s) found_.track.readout_s = project_.camera.readout_s;
  }

  const Project& project_;
  const EgoMotionControl& control_;
  double max_unknown_share_;
  SceneFiles files_;
  std::optional<Track> log_;
  ProjectMotion found_;
};

// --- The horizon in sight against the camera's attitude.

constexpr int kLevelFrames = 12;
constexpr int kMaxWidth_px = 640;
constexpr double kSameLevel_rad = rad_of_deg(2);
constexpr double kContradiction_rad = rad_of_deg(3);

// A horizon in an image.
struct SeenLevel {
  int frame = 0;
  glm::dvec3 up_in_world;  // by the camera's attitude; 0, 0, -1 where that is right
  Attitude seen;           // roll and pitch of the camera by the image
  Attitude stated;         // by the scene
  double sd_rad = 0;
};

SeenLevel seen_level(const SeenHorizon& horizon, const Scene& scene) {
  const glm::dquat rotation = camera_at(scene.motion, time_of_frame_s(scene.footage, horizon.frame)).rotation;
  const glm::dvec3& up = horizon.up_in_camera;
  return {.frame = horizon.frame,
          .up_in_world = rotation * up,
          .seen = {.roll_rad = std::atan2(-up.y, -up.z), .pitch_rad = std::asin(std::clamp(up.x, -1.0, 1.0))},
          .stated = attitude_of(rotation),
          .sd_rad = horizon.sd_rad};
}

// Those that agree with one of them, which comes first; of all such sets the largest.
std::vector<const SeenLevel*> agreeing(const std::vector<SeenLevel>& levels) {
  std::vector<const SeenLevel*> most;
  for (const SeenLevel& one : levels) {
    std::vector<const SeenLevel*> with_it{&one};
    for (const SeenLevel& other : levels)
      if (&other != &one && angle_between(one.up_in_world, other.up_in_world) < kSameLevel_rad)
        with_it.push_back(&other);
    if (with_it.size() > most.size()) most = std::move(with_it);
  }
  return most;
}

std::string tilt_text(const Attitude& attitude) {
  return fmt::format("roll {:.1f} and pitch {:.1f}", deg_of_rad(attitude.roll_rad), deg_of_rad(attitude.pitch_rad));
}

Problem contradiction(const Project& project, const SeenLevel& level) {
  const CameraSettings& camera = project.camera;
  const std::string what = fmt::format("in frame {} the camera has {} degrees, but the horizon in the image says {}",
                                       level.frame, tilt_text(level.stated), tilt_text(level.seen));
  const bool is_by_log = !camera.track.file.empty() && camera.track.attitude != TrackAttitudeChoice::none;
  const bool has_mount = camera.roll_deg.value_or(0) != 0 || camera.pitch_deg.value_or(0) != 0;
  if (is_by_log && has_mount && camera.track.mount != TrackMountChoice::none)
    return {"camera.track.mount",
            what +
                ": camera.attitude_deg is added to the log's attitude as the mount's angles; if the log's is the "
                "camera's own, set this to none"};
  return {"camera.attitude_deg",
          what + ": drag the horizon in the editor, or let `sigs ego-motion --into` find the attitude"};
}

}  // namespace

FoundAttitudes found_attitudes(const EgoMotion& motion, const std::string& file) {
  const bool is_complete =
      std::none_of(motion.frames.begin(), motion.frames.end(), [](const EgoFrame& frame) { return frame.is_lost; });
  FoundAttitudes found{.file = file, .is_complete = is_complete};
  if (motion.level_sd_rad && !motion.frames.empty())
    found.level_at_start = attitude_of(motion.frames.front().world_from_camera);
  return found;
}

void follow_attitudes(Project& project, const FoundAttitudes& found) {
  CameraSettings& camera = project.camera;
  const bool leaves_positions_out = !camera.track.file.empty() && camera.track.position == TrackPositionChoice::none;
  camera.track = {.file = found.file,
                  .position = leaves_positions_out ? TrackPositionChoice::none : TrackPositionChoice::automatic,
                  .attitude = TrackAttitudeChoice::camera,
                  .mount = TrackMountChoice::none,
                  .incomplete = found.is_complete ? IncompleteTrackChoice::refuse : IncompleteTrackChoice::use};
  camera.attitude_file.clear();
  if (found.stated_at_start) {
    camera.roll_deg = rounded_deg(found.stated_at_start->roll_rad);
    camera.pitch_deg = rounded_deg(found.stated_at_start->pitch_rad);
    camera.yaw_deg = rounded_deg(found.stated_at_start->yaw_rad);
  }
  if (found.level_at_start) {
    camera.roll_deg = rounded_deg(found.level_at_start->roll_rad);
    camera.pitch_deg = rounded_deg(found.level_at_start->pitch_rad);
  }
  if (found.heading_of_world_rad && !project.geo.heading_deg)
    project.geo.heading_deg = rounded_deg(*found.heading_of_world_rad);
}

Result<ProjectMotion> estimated_project_motion(const Project& project, const EgoMotionControl& control,
                                               double max_unknown_share) {
  return Estimating(project, control, max_unknown_share).run();
}

SeenHorizons seen_horizons(FrameSource& footage, const Scene& scene, const std::atomic<bool>* cancel) {
  const cv::Size size = scene.footage.size_px;
  const double scale = std::max(1.0, double(size.width) / kMaxWidth_px);
  const cv::Size reduced(static_cast<int>(std::lround(size.width / scale)),
                         static_cast<int>(std::lround(size.height / scale)));
  const cv::Mat own_body = bytes_of_share(scene.own_body);
  const int length = scene.last_frame - scene.first_frame + 1;
  const int count = std::min(kLevelFrames, length);
  SeenHorizons seen;
  for (int i = 0; i < count; ++i) {
    if (cancel != nullptr && cancel->load()) break;
    const int number = scene.first_frame + static_cast<int>((2LL * i + 1) * length / (2LL * count));
    const Result<Frame> frame = footage.read(number);
    if (!frame || frame->damaged) continue;
    ++seen.frames;
    cv::Mat small;
    cv::resize(luma_of(*frame), small, reduced, 0, 0, cv::INTER_AREA);
    if (const auto line = horizon_in(small, scale, scene.camera, own_body, number))
      seen.horizons.push_back({.frame = number,
                               .up_in_camera = line->up,
                               .sd_rad = std::hypot(line->sd_rad, line->haze_rad, line->hills_rad)});
  }
  return seen;
}

std::optional<Problem> level_contradiction(const SeenHorizons& seen, const Project& project, const Scene& scene) {
  if (!scene.horizon_is_known) return std::nullopt;
  std::vector<SeenLevel> levels;
  for (const SeenHorizon& horizon : seen.horizons) levels.push_back(seen_level(horizon, scene));
  const std::vector<const SeenLevel*> same = agreeing(levels);
  if (same.empty() || 2 * same.size() < static_cast<std::size_t>(seen.frames)) return std::nullopt;
  glm::dvec3 up(0);
  double sd_rad = 0;
  for (const SeenLevel* level : same) {
    up += level->up_in_world;
    sd_rad = std::max(sd_rad, level->sd_rad);
  }
  if (angle_between(up, {0, 0, -1}) < kContradiction_rad + 3 * sd_rad) return std::nullopt;
  return contradiction(project, *same.front());
}

}  // namespace sigs
