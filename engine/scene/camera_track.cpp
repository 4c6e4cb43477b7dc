// SPDX-License-Identifier: MIT
#include "scene/camera_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "project/places.h"
#include "project/project.h"
#include "scene/scene_at.h"
#include "spline/piecewise_cubic.h"
#include "telemetry/log_samples.h"
#include "telemetry/track_report.h"

namespace sigs {
namespace {

constexpr double kMinCourseSpeed_mps = 1;  // below it the course over ground is mostly noise
constexpr double kMinPathStep_s = 1e-6;    // samples nearer together than this count as one
constexpr double kSlowAttitude_s = 0.25;   // between two samples much happens that is not known
constexpr double kSlowPosition_s = 2;

tl::unexpected<Problem> log_problem(std::string what, ErrorKind kind = ErrorKind::bad_project) {
  return tl::unexpected<Problem>(Problem{"camera.track.file", std::move(what), kind});
}

// The frames of the project on the log's time axis.
struct LogTimes {
  double offset_s = 0;
  double first_s = 0;  // of the project's first frame
  double last_s = 0;

  [[nodiscard]] double footage_s(double log_s) const { return log_s - offset_s; }
};

LogTimes log_times(const TrackSettings& settings, const FootageShape& footage, const FrameRange& range) {
  return {settings.offset_s, time_of_frame_s(footage, range.first) + settings.offset_s,
          time_of_frame_s(footage, range.last) + settings.offset_s};
}

// Empty where the samples cover the project's frames, give or take one sample; else what they cover.
std::string not_covered(const std::vector<double>& times_s, const std::string& source, const LogTimes& times) {
  const double slack_s = median_interval_s(times_s) + 1e-6;
  if (times_s.front() <= times.first_s + slack_s && times_s.back() >= times.last_s - slack_s) return {};
  return fmt::format("{} covers {:.3f} to {:.3f} s of the log, the project's frames {:.3f} to {:.3f} s", source,
                     times_s.front(), times_s.back(), times.first_s, times.last_s);
}

bool overlaps(const std::vector<double>& times_s, const LogTimes& times) {
  return times_s.front() <= times.last_s && times_s.back() >= times.first_s;
}

// Checks what is used of a log against the project's frames.
class Coverage {
 public:
  Coverage(const Track& track, IncompleteTrackChoice choice, const LogTimes& times)
      : track_(track), choice_(choice), times_(times) {}

  template <class T>
  void add(const Channel<T>& channel) {
    if (!overlaps(channel.times_s, times_)) is_apart_ = true;
    if (std::string what = not_covered(channel.times_s, channel.source, times_); !what.empty()) gaps_.push_back(what);
  }

  // Warnings of what is used nevertheless.
  [[nodiscard]] Result<std::vector<Warning>, Problem> verdict() const {
    if (is_apart_) return log_problem(gaps_.front() + "; they do not overlap: set camera.track.offset_s");
    if (choice_ == IncompleteTrackChoice::use) {
      std::vector<Warning> warnings;
      for (const std::string& gap : gaps_)
        warnings.push_back(
            {track_.file.string(), gap + "; beyond that the camera flies straight on and does not turn"});
      return warnings;
    }
    const std::string remedy = "; set camera.track.incomplete to use if its sound part will do";
    if (track_.damaged) return log_problem("is damaged" + first_warning() + remedy, ErrorKind::bad_data);
    if (!gaps_.empty()) return log_problem(gaps_.front() + remedy);
    return std::vector<Warning>();
  }

 private:
  [[nodiscard]] std::string first_warning() const {
    return track_.warnings.empty() ? std::string() : ": " + track_.warnings.front().what;
  }

  const Track& track_;
  IncompleteTrackChoice choice_;
  LogTimes times_;
  bool is_apart_ = false;
  std::vector<std::string> gaps_;
};

// The attitude that the settings ask for; null: none of it.
const Channel<glm::dquat>* attitude_channel(const Track& track, TrackAttitudeChoice choice) {
  const Channel<glm::dquat>& camera = track.ned_from_camera;
  const Channel<glm::dquat>& airframe = track.ned_from_airframe;
  switch (choice) {
    case TrackAttitudeChoice::automatic:
      return !camera.empty() ? &camera : !airframe.empty() ? &airframe : nullptr;
    case TrackAttitudeChoice::camera:
      return !camera.empty() ? &camera : nullptr;
    case TrackAttitudeChoice::airframe:
      return !airframe.empty() ? &airframe : nullptr;
    case TrackAttitudeChoice::none:
      break;
  }
  return nullptr;
}

// What of a log is used. Null: not there, or not wanted.
struct UsedParts {
  const Channel<glm::dquat>* attitude = nullptr;
  const Channel<GeodeticPosition>* places = nullptr;
  const Channel<glm::dvec3>* local_m = nullptr;  // only without places
};

Result<UsedParts, Problem> used_parts(const Track& track, const TrackSettings& settings) {
  UsedParts parts{.attitude = attitude_channel(track, settings.attitude)};
  if (settings.position != TrackPositionChoice::none) {
    if (!track.position.empty())
      parts.places = &track.position;
    else if (!track.local_position_ned_m.empty())
      parts.local_m = &track.local_position_ned_m;
  }
  const bool wants_attitude =
      settings.attitude == TrackAttitudeChoice::camera || settings.attitude == TrackAttitudeChoice::airframe;
  if (wants_attitude && parts.attitude == nullptr)
    return log_problem(fmt::format("has no attitude of the {}, which camera.track.attitude asks for",
                                   settings.attitude == TrackAttitudeChoice::camera ? "camera" : "airframe"));
  const bool has_position = parts.places != nullptr || parts.local_m != nullptr;
  if (settings.position == TrackPositionChoice::log && !has_position)
    return log_problem("has no position, which camera.track.position asks for");
  if (settings.attitude == TrackAttitudeChoice::automatic && parts.attitude == nullptr)
    return log_problem("has no attitude, so that nothing would be locked to the images; it has " +
                       contents_text(track) +
                       ": let `sigs ego-motion --into` find the attitude in the images, or set camera.track.attitude "
                       "to none to go on without");
  if (parts.attitude == nullptr && !has_position)
    return log_problem("has neither attitude nor position that camera.track.attitude and camera.track.position allow");
  return parts;
}

std::vector<PlatformAttitude> on_footage_time(const Channel<glm::dquat>& channel, const LogTimes& times) {
  std::vector<PlatformAttitude> turns;
  for (std::size_t i = 0; i < channel.values.size(); ++i)
    turns.push_back({times.footage_s(channel.times_s[i]), channel.values[i]});
  return turns;
}

double yaw_at(const std::vector<PlatformAttitude>& turns, double time_s) {
  return attitude_of(world_from_platform_at(turns, time_s)).yaw_rad;
}

// Samples of a channel on the footage's time axis, as waypoints of a curve; of those at the same time the first.
template <class T, class PointOf>
std::vector<TimedWaypoint> points_of(const Channel<T>& channel, const LogTimes& times, const PointOf& point_of) {
  std::vector<TimedWaypoint> points;
  for (std::size_t i = 0; i < channel.values.size(); ++i) {
    const double time_s = times.footage_s(channel.times_s[i]);
    if (!points.empty() && time_s - points.back().time_s < kMinPathStep_s) continue;
    points.push_back({time_s, point_of(channel.values[i])});
  }
  return points;
}

// Displacement in NED of the tangent plane at the place of the first sample.
std::vector<TimedWaypoint> ned_points(const UsedParts& parts, const LogTimes& times) {
  if (parts.local_m != nullptr) return points_of(*parts.local_m, times, [](const glm::dvec3& ned) { return ned; });
  const LocalFrame north(parts.places->values.front(), 0);
  return points_of(*parts.places, times, [&](const GeodeticPosition& place) { return north.world_of(place); });
}

// Heading of world X against north, rad.
double heading_of_world(const Project& project, const Track& track, const UsedParts& parts, const LogTimes& times,
                        std::vector<Warning>& warnings) {
  if (project.geo.heading_deg) return rad_of_deg(*project.geo.heading_deg);
  if (parts.attitude != nullptr && track.heading_is_north) return yaw_at(on_footage_time(*parts.attitude, times), 0);
  if (parts.places == nullptr && parts.local_m == nullptr) return 0;
  const glm::dvec3 velocity_mps = interpolating_spline(ned_points(parts, times)).motion_at(0).velocity_mps;
  if (std::hypot(velocity_mps.x, velocity_mps.y) > kMinCourseSpeed_mps) {
    const double course_rad = std::atan2(velocity_mps.y, velocity_mps.x);
    warnings.push_back({track.file.string(),
                        fmt::format("does not know where the camera heads; world X is taken along the course over "
                                    "ground, {:.1f} degrees; geo.heading_deg can state it",
                                    deg_of_rad(course_rad))});
    return course_rad;
  }
  warnings.push_back({track.file.string(),
                      "does not know where the camera heads, and it hardly moves; world X is taken to be north; "
                      "geo.heading_deg can state it"});
  return 0;
}

// The place of the world's origin that puts a place at a point of the world.
GeodeticPosition origin_for(const GeodeticPosition& place, const glm::dvec3& p_in_world, double heading_rad) {
  GeodeticPosition origin = place;
  for (int i = 0; i < 4; ++i) {  // each step turns by the angle between two tangent planes less: 1e-5 rad at 100 m
    const glm::dvec3 off_m = LocalFrame(origin, heading_rad).world_of(place) - p_in_world;
    origin = LocalFrame(origin, heading_rad).place_of(off_m);
  }
  return origin;
}

// Where the camera is at the footage's frame 0 by the log.
GeodeticPosition place_at_start(const UsedParts& parts, const LogTimes& times) {
  const LocalFrame north(parts.places->values.front(), 0);
  return north.place_of(interpolating_spline(ned_points(parts, times)).motion_at(0).position_m);
}

std::optional<LocalFrame> frame_of_log(const Project& project, const UsedParts& parts, const LogTimes& times,
                                       double heading_rad) {
  const GeoSettings& geo = project.geo;
  if (geo.latitude_deg && geo.longitude_deg) {
    GeodeticPosition origin{*geo.latitude_deg, *geo.longitude_deg, geo.height_m.value_or(0)};
    if (!geo.height_m && parts.places != nullptr)
      origin.height_m = place_at_start(parts, times).height_m + project.camera.position_m.z;
    return LocalFrame(origin, heading_rad);
  }
  if (parts.places == nullptr) return std::nullopt;
  GeodeticPosition origin = origin_for(place_at_start(parts, times), project.camera.position_m, heading_rad);
  if (geo.height_m) origin.height_m = *geo.height_m;
  return LocalFrame(origin, heading_rad);
}

std::shared_ptr<const PiecewiseCubic> path_of(const Project& project, const UsedParts& parts, const LogTimes& times,
                                              const std::optional<LocalFrame>& earth, double heading_rad) {
  std::vector<TimedWaypoint> points;
  if (parts.places != nullptr) {
    points = points_of(*parts.places, times, [&](const GeodeticPosition& place) { return earth->world_of(place); });
  } else {
    const LocalFrame turned({}, heading_rad);
    points = points_of(*parts.local_m, times, [&](const glm::dvec3& ned) { return turned.world_of_ned(ned); });
    const glm::dvec3 start_m = interpolating_spline(points).motion_at(0).position_m;
    for (TimedWaypoint& point : points) point.position_m += project.camera.position_m - start_m;
  }
  return std::make_shared<const PiecewiseCubic>(interpolating_spline(points));
}

// Whether the log's attitude is the camera's own rather than that of what it is mounted on.
bool is_whole(const Track& track, const UsedParts& parts, TrackMountChoice mount) {
  if (mount != TrackMountChoice::automatic) return mount == TrackMountChoice::none;
  return track.attitude_is_whole && parts.attitude == &track.ned_from_camera;
}

void turn_by_log(const Project& project, const Track& track, const UsedParts& parts, const LogTimes& times,
                 double heading_rad, CameraFlight& flight) {
  flight.motion.attitudes = on_footage_time(*parts.attitude, times);
  // Where yaw is not against north, it counts from the heading at frame 0, which is that of world X.
  const double zero_rad = track.heading_is_north ? heading_rad : yaw_at(flight.motion.attitudes, 0);
  const glm::dquat world_from_ned = rotation_of({0, 0, -zero_rad});
  const bool is_level_known = track.level_is_known || parts.attitude != &track.ned_from_camera;
  const bool is_own = is_whole(track, parts, project.camera.track.mount);
  // camera.attitude_deg stands on the right where it is the mount's. Where it is the camera's own at the start, the
  // part of it that the log does not know stands on the left: all of it, the heading, or nothing. What stands on the
  // right of all turns (camera_at) is taken off again, and so is the mount of a rig's first camera, whose own it is.
  const glm::dquat none(1, 0, 0, 0);
  const glm::dquat mount =
      is_own && project.rig_view ? body_from_camera(project.rig_view->reference_mount).rotation : none;
  const glm::dquat given = flight.motion.world_from_camera_at_start.rotation;
  const glm::dquat heading = rotation_of({0, 0, rad_of_deg(project.camera.yaw_deg)});
  const glm::dquat left = !is_level_known ? given * mount : is_own && !track.heading_is_north ? heading : none;
  const glm::dquat right = is_own || !is_level_known ? glm::conjugate(mount) * glm::conjugate(given) : none;
  for (PlatformAttitude& turn : flight.motion.attitudes)
    turn.world_from_platform = glm::normalize(left * world_from_ned * turn.world_from_platform * right);
  const Channel<glm::dvec3>& sd = track.camera_attitude_sd_rad;
  if (parts.attitude == &track.ned_from_camera)
    for (std::size_t i = 0; i < sd.values.size(); ++i)
      flight.motion.deviations.push_back({times.footage_s(sd.times_s[i]), turned_sd(mount, sd.values[i])});
  flight.motion.source.attitude = fmt::format("{}: {}", track.format, parts.attitude->source);
  flight.horizon_is_known = flight.horizon_is_known || is_level_known;
  if (!flight.horizon_is_known)
    flight.warnings.push_back({track.file.string(),
                               "has roll and pitch against its first sample alone, which counts as level; "
                               "camera.attitude_deg can state what they were"});
}

// Of the log, without samples that are no exposure times.
std::vector<ExposureTime> exposures_of(const Channel<double>& channel, const LogTimes& times) {
  constexpr double kMaxExposure_s = 1;
  std::vector<ExposureTime> exposures;
  for (std::size_t i = 0; i < channel.values.size(); ++i)
    if (channel.values[i] >= 0 && channel.values[i] <= kMaxExposure_s)
      exposures.push_back({times.footage_s(channel.times_s[i]), channel.values[i]});
  return exposures;
}

void warn_if_slow(const Track& track, const UsedParts& parts, std::vector<Warning>& warnings) {
  const auto add = [&](const std::string& source, double step_s) {
    warnings.push_back({track.file.string(), fmt::format("{} has a sample only each {:.2g} s; what the camera does in "
                                                         "between is not known",
                                                         source, step_s)});
  };
  if (parts.attitude != nullptr)
    if (const double step_s = median_interval_s(parts.attitude->times_s); step_s >= kSlowAttitude_s)
      add(parts.attitude->source, step_s);
  if (parts.places != nullptr)
    if (const double step_s = median_interval_s(parts.places->times_s); step_s >= kSlowPosition_s)
      add(parts.places->source, step_s);
}

// Of a path of geodetic positions.
glm::bvec3 moves_with_start(const GeoSettings& geo) {
  const bool level = !geo.latitude_deg || !geo.longitude_deg;
  return {level, level, !geo.height_m};
}

}  // namespace

CameraFlight steady_flight(const Project& project) {
  const GeoSettings& geo = project.geo;
  CameraFlight flight{.motion = steady_motion(project), .horizon_is_known = knows_horizon(project.camera)};
  if (geo.latitude_deg && geo.longitude_deg)
    flight.earth = LocalFrame({*geo.latitude_deg, *geo.longitude_deg, geo.height_m.value_or(0)},
                              rad_of_deg(geo.heading_deg.value_or(0)));
  return flight;
}

void set_camera_motion(Scene& scene, CameraFlight flight) {
  scene.motion = std::move(flight.motion);
  scene.earth = std::move(flight.earth);
  scene.utc_at_frame_0_s = flight.utc_at_frame_0_s;
  scene.horizon_is_known = flight.horizon_is_known;
  scene.warnings.insert(scene.warnings.end(), flight.warnings.begin(), flight.warnings.end());
}

Result<CameraFlight, Problem> flight_by_log(const Project& project, const Track& track, const FootageShape& footage,
                                            const FrameRange& range) {
  const LogTimes times = log_times(project.camera.track, footage, range);
  CameraFlight flight = steady_flight(project);
  const TrackSettings& settings = project.camera.track;
  const Result<UsedParts, Problem> parts = used_parts(track, settings);
  if (!parts) return tl::unexpected<Problem>(parts.error());
  Coverage coverage(track, settings.incomplete, times);
  if (parts->attitude != nullptr) coverage.add(*parts->attitude);
  if (parts->places != nullptr) coverage.add(*parts->places);
  if (parts->local_m != nullptr) coverage.add(*parts->local_m);
  const Result<std::vector<Warning>, Problem> gaps = coverage.verdict();
  if (!gaps) return tl::unexpected<Problem>(gaps.error());
  flight.warnings = track.warnings;
  flight.warnings.insert(flight.warnings.end(), gaps->begin(), gaps->end());
  warn_if_slow(track, *parts, flight.warnings);
  if (parts->attitude == &track.ned_from_airframe && settings.attitude == TrackAttitudeChoice::automatic)
    flight.warnings.push_back({track.file.string(),
                               "has the airframe's attitude alone, which a camera on a gimbal does not share; set "
                               "camera.track.attitude to airframe if the camera is fixed to it, else to none"});

  const double heading_rad = heading_of_world(project, track, *parts, times, flight.warnings);
  flight.earth = frame_of_log(project, *parts, times, heading_rad);
  if (parts->places != nullptr || parts->local_m != nullptr) {
    flight.motion.path = path_of(project, *parts, times, flight.earth, heading_rad);
    const std::string& source = parts->places != nullptr ? parts->places->source : parts->local_m->source;
    flight.motion.source.position = fmt::format("{}: {}", track.format, source);
    if (parts->places != nullptr) flight.motion.moves_with_start = moves_with_start(project.geo);
  }
  if (parts->attitude != nullptr) turn_by_log(project, track, *parts, times, heading_rad, flight);
  if (const int unknown = unknown_attitudes(flight.motion, footage, range); unknown > 0) {
    const int frames = range.last - range.first + 1;
    const std::string what = fmt::format(
        "does not know the camera's attitude in {} of the project's {} frames: the standard deviation is "
        "above 90 degrees; intruders are not locked to the images there",
        unknown, frames);
    if (2 * unknown > frames && settings.incomplete == IncompleteTrackChoice::refuse)
      return log_problem(what + "; set camera.track.incomplete to use if that will do");
    flight.warnings.insert(flight.warnings.begin(), {track.file.string(), what});
  }
  flight.motion.readout_s = project.camera.readout_s.value_or(track.readout_s.value_or(0));
  if (!project.camera.exposure_s) flight.motion.exposures = exposures_of(track.exposure_s, times);
  flight.motion.logged_white_cdpm2 = value_near(track.white_cdpm2, (times.first_s + times.last_s) / 2);
  if (track.utc_at_zero_s) flight.utc_at_frame_0_s = *track.utc_at_zero_s + settings.offset_s;
  return flight;
}

Result<CameraFlight, Problem> camera_flight(const Project& project, const FootageShape& footage,
                                            const FrameRange& range, SceneFiles& files) {
  CameraFlight flight = steady_flight(project);
  if (!project.camera.track.file.empty()) {
    const Result<std::shared_ptr<const Track>> track = files.track(resolved(project, project.camera.track.file));
    if (!track) return log_problem(track.error().text(), track.error().kind);
    Result<CameraFlight, Problem> by_log = flight_by_log(project, **track, footage, range);
    if (!by_log) return by_log;
    flight = *std::move(by_log);
  }
  if (flight.motion.readout_s > 0 && project.compositing.method == MethodChoice::classic)
    return tl::unexpected<Problem>(Problem{
        "camera.readout_s", "is above 0, or the log's is; the classic method knows no rolling shutter: set it to 0"});
  Result<std::vector<PlatformAttitude>, Problem> turns = scene_platform_attitudes(project, footage, files);
  if (!turns) return tl::unexpected<Problem>(turns.error());
  if (!turns->empty()) flight.motion.attitudes = *std::move(turns);
  for (AttitudeDeviation& deviation : flight.motion.deviations)
    if (flight.motion.mount)
      deviation.sd_rad = turned_sd(glm::conjugate(flight.motion.mount->rotation), deviation.sd_rad);
  return flight;
}

}  // namespace sigs
