// SPDX-License-Identifier: MIT
#include "scene/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/pose.h"
#include "project/project.h"
#include "scene/model.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"

namespace sigs {

std::vector<double> waypoint_frames(const std::vector<WaypointSettings>& waypoints, int first_frame, int last_frame) {
  if (waypoints.empty()) return {};
  std::vector<std::optional<double>> frames;
  for (const WaypointSettings& waypoint : waypoints) frames.push_back(waypoint.frame);
  if (!frames.front()) frames.front() = first_frame;
  if (!frames.back()) frames.back() = last_frame;

  std::vector<double> spread(frames.size(), *frames.front());
  std::size_t known = 0;  // the last waypoint that carries a frame
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (!frames[i]) continue;
    const double step = (*frames[i] - *frames[known]) / static_cast<double>(i - known);
    for (std::size_t j = known + 1; j < i; ++j) spread[j] = *frames[known] + step * static_cast<double>(j - known);
    spread[i] = *frames[i];
    known = i;
  }
  return spread;
}

std::vector<TimedWaypoint> timed_waypoints(const std::vector<WaypointSettings>& waypoints, const FootageShape& footage,
                                           int first_frame, int last_frame) {
  const std::vector<double> frames = waypoint_frames(waypoints, first_frame, last_frame);
  std::vector<TimedWaypoint> timed;
  for (std::size_t i = 0; i < frames.size(); ++i)
    timed.push_back({time_of_frame_s(footage, frames[i]), waypoints[i].position_m});
  return timed;
}

std::vector<double> waypoint_frames(const std::vector<WaypointSettings>& waypoints, const Scene& scene) {
  const std::optional<Timeline>& other = scene.timeline;
  return waypoint_frames(waypoints, other ? other->first_frame : scene.first_frame,
                         other ? other->last_frame : scene.last_frame);
}

std::vector<TimedWaypoint> timed_waypoints(const std::vector<WaypointSettings>& waypoints, const Scene& scene) {
  const std::optional<Timeline>& other = scene.timeline;
  return other ? timed_waypoints(waypoints, other->footage, other->first_frame, other->last_frame)
               : timed_waypoints(waypoints, scene.footage, scene.first_frame, scene.last_frame);
}

namespace {

tl::unexpected<Problem> problem(std::string field, std::string what, ErrorKind kind = ErrorKind::bad_project) {
  return tl::unexpected<Problem>(Problem{std::move(field), std::move(what), kind});
}

// The error of a file as a problem of the field that names the file.
tl::unexpected<Problem> in_field(std::string field, const Error& error) {
  return problem(std::move(field), error.text(), error.kind);
}

ModelAxes axes_of(const ModelSettings& model) {
  return {.forward = model.forward,
          .up = model.up,
          .scale = model.scale,
          .length_m = model.length_m,
          .anchor_at_bounds = model.anchor == AnchorChoice::bounds};
}

ModelSurfaces surfaces_of(const ModelSettings& model) {
  ModelSurfaces surfaces{.gloss = model.gloss};
  for (const RotorSettings& rotor : model.rotors)
    surfaces.rotors.push_back({.part = rotor.part,
                               .blade_count = rotor.blades,
                               .rpm = rotor.rpm,
                               .chord_m = rotor.chord_m,
                               .phase_rad = rad_of_deg(rotor.phase_deg),
                               .coning_rad = rad_of_deg(rotor.coning_deg),
                               .axis = rotor.axis,
                               .radius_m = rotor.radius_m,
                               .hub_m = rotor.hub_m});
  return surfaces;
}

// read_obj names the setting where it is not the file that is wrong.
bool is_model_setting(const std::string& where) {
  constexpr std::array<std::string_view, 4> kSettings{"forward", "up", "scale", "length_m"};
  return where.starts_with("rotors[") || std::find(kSettings.begin(), kSettings.end(), where) != kSettings.end();
}

std::string waypoint_frame_text(const WaypointSettings& waypoint, double frame) {
  return fmt::format("{:g}{}", frame, waypoint.frame ? "" : " (spread over the project's frames)");
}

}  // namespace

std::string key_of_intruder(std::size_t intruder) {
  return fmt::format("intruders[{}]", intruder);
}

namespace {

std::optional<double> rad_of_deg(const std::optional<double>& angle_deg) {
  return angle_deg ? std::optional(sigs::rad_of_deg(*angle_deg)) : std::nullopt;
}

}  // namespace

CameraMotion steady_motion(const Project& project) {
  const CameraSettings& camera = project.camera;
  return {
      .world_from_camera_at_start = {rotation_of(mount_attitude(camera)), camera.position_m},
      .speed_mps = camera.speed_mps,
      .readout_s = camera.readout_s.value_or(0),
      .exposures = camera.exposure_s ? std::vector<ExposureTime>{{0, *camera.exposure_s}} : std::vector<ExposureTime>{},
      .mount = project.rig_view ? std::optional(body_from_camera(project.rig_view->mount)) : std::nullopt};
}

namespace {

SceneLight light_of(const LightSettings& light) {
  return {.kind = light.kind,
          .position_m = light.position_m,
          .color = light.color,
          .ambient = light.ambient,
          .sun_azimuth_rad = rad_of_deg(light.sun.azimuth_deg),
          .sun_elevation_rad = rad_of_deg(light.sun.elevation_deg),
          .sky_color = light.sky_color,
          .ground_color = light.ground_color,
          .exposure = light.exposure,
          .ground_shadow = light.ground_shadow,
          .white_cdpm2 = light.white_cdpm2};
}

// A scene that a thermal camera sees: surfaces send out what their materials say, from every side alike (model.h), and
// code values mix, as they stand for heat.
void see_heat(HeatPalette palette, Scene& scene) {
  scene.is_thermal = true;
  scene.palette = palette;
  scene.light = {.kind = LightKind::point, .ambient = 1};
  scene.compositing.blend = BlendChoice::heat;
}

}  // namespace

Scene bare_scene(const Project& project, const FootageShape& footage) {
  Scene scene{.camera = {.lens = *Lens::make({}), .size_px = footage.size_px},
              .motion = steady_motion(project),
              .light = light_of(project.light),
              .compositing = project.compositing,
              .rotors_count = project.output.label_rotors != LabelRotorsChoice::none,
              .appearance = project.appearance,
              .footage = footage,
              .horizon_is_known = knows_horizon(project.camera)};
  if (project.footage.spectrum == Spectrum::thermal) see_heat(project.footage.palette, scene);
  if (const std::optional<double> distance_m = project.footage.cloud_distance_m)
    scene.clouds = Clouds{.distance_m = *distance_m, .depth_m = project.footage.cloud_depth_m};
  return scene;
}

Result<FrameRange, Problem> scene_range(const FootageSettings& settings, const FootageShape& footage) {
  const int count = static_cast<int>(footage.times_s.size());
  const FrameRange range{settings.first_frame, settings.last_frame.value_or(count - 1)};
  const std::string available = fmt::format("the footage has {} frames, 0 to {}", count, count - 1);
  if (range.first < 0 || range.first >= count) return problem("footage.first_frame", available);
  if (range.last < range.first || range.last >= count) return problem("footage.last_frame", available);
  return range;
}

Result<std::optional<Timeline>, Problem> scene_timeline(const Project& project, SceneFiles& files) {
  if (!project.rig_view || project.rig_view->camera == 0) return std::optional<Timeline>();
  Project first = project;
  first.footage = project.rig_view->reference;
  first.rig_view->camera = 0;
  Result<FootageShape> footage = files.footage_shape(first);
  if (!footage) return problem("cameras[0].footage.video", footage.error().text(), footage.error().kind);
  const Result<FrameRange, Problem> range = scene_range(first.footage, *footage);
  if (!range) return problem("cameras[0]." + range.error().field, range.error().what);
  return Timeline{*std::move(footage), range->first, range->last};
}

namespace {

// What of a range lies within the timeline's, by the middles between its frames.
Result<FrameRange, Problem> common_range(const FrameRange& range, const FootageShape& footage,
                                         const Timeline& timeline) {
  const double first_s = time_of_frame_s(timeline.footage, timeline.first_frame);
  const double last_s = time_of_frame_s(timeline.footage, timeline.last_frame);
  const double first = std::ceil(frame_at_time(footage, first_s) - 0.5);
  const double last = std::floor(frame_at_time(footage, last_s) + 0.5);
  const FrameRange common{static_cast<int>(std::clamp<double>(first, range.first, range.last + 1.0)),
                          static_cast<int>(std::clamp<double>(last, range.first - 1.0, range.last))};
  if (common.first <= common.last) return common;
  return problem("clock.offset_s",
                 fmt::format("puts its frames {} to {} at {:.3f} to {:.3f} s, when the first camera, from {:.3f} to "
                             "{:.3f} s, is not filming",
                             range.first, range.last, time_of_frame_s(footage, range.first),
                             time_of_frame_s(footage, range.last), first_s, last_s));
}

}  // namespace

Result<void, Problem> set_range(Scene& scene, const Project& project, SceneFiles& files) {
  Result<FrameRange, Problem> range = scene_range(project.footage, scene.footage);
  if (!range) return tl::unexpected<Problem>(range.error());
  Result<std::optional<Timeline>, Problem> timeline = scene_timeline(project, files);
  if (!timeline) return tl::unexpected<Problem>(timeline.error());
  scene.timeline = *std::move(timeline);
  if (scene.timeline) range = common_range(*range, scene.footage, *scene.timeline);
  if (!range) return tl::unexpected<Problem>(range.error());
  scene.first_frame = range->first;
  scene.last_frame = range->last;
  return {};
}

Result<Camera, Problem> scene_camera(const Project& project, const FootageShape& footage, SceneFiles& files) {
  Result<Camera> camera =
      files.camera(resolved(project, project.footage.calibration), footage, project.footage.lens_model);
  if (!camera) return in_field("footage.calibration", camera.error());
  return *std::move(camera);
}

std::optional<Problem> panorama_problem(const Scene& scene) {
  if (!(scene.camera.lens.period_px() > 0)) return std::nullopt;
  if (scene.compositing.method != MethodChoice::direct)
    return Problem{"compositing.method", "needs a flat image, which 360 degree footage is not; use direct"};
  if (scene.footage.part)
    return Problem{"footage.crop",
                   "leaves a part of 360 degree footage, whose lens is that of the whole; leave it out"};
  if (scene.motion.readout_s > 0)
    return Problem{
        "camera.readout_s",
        "is of a rolling shutter, which 360 degree footage, stitched of several images, does not have row by "
        "row; set it to 0"};
  return std::nullopt;
}

Result<std::vector<PlatformAttitude>, Problem> scene_platform_attitudes(const Project& project,
                                                                        const FootageShape& footage,
                                                                        SceneFiles& files) {
  std::vector<PlatformAttitude> turns;
  if (project.camera.attitude_file.empty()) return turns;
  const Result<std::vector<AttitudeAtFrame>> known = files.attitudes(resolved(project, project.camera.attitude_file));
  if (!known) return in_field("camera.attitude_file", known.error());
  const Result<std::optional<Timeline>, Problem> timeline = scene_timeline(project, files);
  if (!timeline) return tl::unexpected<Problem>(timeline.error());
  const FootageShape& counted = *timeline ? (*timeline)->footage : footage;
  for (const AttitudeAtFrame& one : *known)
    turns.push_back({time_of_frame_s(counted, one.frame), rotation_of(one.attitude)});
  return turns;
}

Result<cv::Mat, Problem> scene_own_body(const Project& project, cv::Size footage_size_px, SceneFiles& files) {
  if (project.footage.own_body_mask.empty()) return cv::Mat();
  const Result<cv::Mat> mask = files.own_body_mask(resolved(project, project.footage.own_body_mask), footage_size_px);
  if (!mask) return in_field("footage.own_body_mask", mask.error());
  return *mask;
}

Result<BoxesByFrame, Problem> scene_real_aircraft(const Project& project, SceneFiles& files) {
  if (project.footage.real_aircraft.empty()) return BoxesByFrame();
  Result<BoxesByFrame> boxes = files.boxes(resolved(project, project.footage.real_aircraft));
  if (!boxes) return in_field("footage.real_aircraft", boxes.error());
  return *std::move(boxes);
}

Result<Occluder, Problem> scene_occluder(const Project& project, const Scene& scene, SceneFiles& files) {
  const FootageSettings& settings = project.footage;
  if (settings.occluder_mask.empty()) return Occluder();
  const Result<cv::Mat> mask = files.own_body_mask(resolved(project, settings.occluder_mask), scene.footage.size_px);
  if (!mask) return in_field("footage.occluder_mask", mask.error());
  const auto count = static_cast<int>(scene.footage.times_s.size());
  if (settings.occluder_frame >= count)
    return problem("footage.occluder_frame", fmt::format("the footage has {} frames, 0 to {}", count, count - 1));
  return Occluder{.mask = *mask,
                  .world_from_camera = camera_at(scene.motion, time_of_frame_s(scene.footage, settings.occluder_frame)),
                  .distance_m = settings.occluder_distance_m};
}

Result<std::shared_ptr<const Model>, Problem> scene_model(const Project& project, std::size_t intruder,
                                                          SceneFiles& files) {
  const ModelSettings& settings = project.intruders[intruder].model;
  const std::optional<HeatLevels> heat =
      project.footage.spectrum == Spectrum::thermal
          ? std::optional(heat_levels_of(project.intruders[intruder].heat, project.appearance.thermal))
          : std::nullopt;
  const Result<std::shared_ptr<const Model>> model =
      files.model(resolved(project, settings.file), axes_of(settings), surfaces_of(settings), heat);
  if (model) return *model;
  const std::string key = key_of_intruder(intruder) + ".model.";
  if (is_model_setting(model.error().where))
    return problem(key + model.error().where, model.error().what, model.error().kind);
  return in_field(key + "file", model.error());
}

// timed: the plan's waypoints.
TrajectorySettings trajectory_settings(const TrajectoryPlan& plan, const std::vector<TimedWaypoint>& timed) {
  TrajectorySettings settings{.spline = plan.spline,
                              .timing = plan.timing,
                              .attitude = plan.attitude,
                              .bank = plan.bank,
                              .bank_limit_rad = rad_of_deg(plan.bank_limit_deg)};
  for (std::size_t i = 0; i < timed.size(); ++i)
    if (const std::optional<double>& heading_deg = plan.waypoints[i].heading_deg)
      settings.headings.push_back({timed[i].time_s, rad_of_deg(*heading_deg)});
  return settings;
}

Result<Trajectory, Problem> scene_trajectory(const Project& project, std::size_t intruder, const Scene& scene) {
  const TrajectoryPlan& plan = project.intruders[intruder].trajectory;
  const std::string key = key_of_intruder(intruder) + ".trajectory.";
  const std::vector<double> frames = waypoint_frames(plan.waypoints, scene);
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames[i] <= frames[i - 1])
      return problem(
          fmt::format("{}waypoints[{}].frame", key, i),
          fmt::format("is {}, not after waypoints[{}], which has {}", waypoint_frame_text(plan.waypoints[i], frames[i]),
                      i - 1, waypoint_frame_text(plan.waypoints[i - 1], frames[i - 1])));
  const std::vector<TimedWaypoint> timed = timed_waypoints(plan.waypoints, scene);
  Result<Trajectory> trajectory = Trajectory::make(timed, trajectory_settings(plan, timed));
  if (!trajectory) return problem(key + trajectory.error().where, trajectory.error().what);
  return *std::move(trajectory);
}

void add_intruder(Scene& scene, const std::string& name, const std::shared_ptr<const Model>& model,
                  const Trajectory& trajectory) {
  if (std::find(scene.models.begin(), scene.models.end(), model) == scene.models.end()) {
    scene.models.push_back(model);
    const std::vector<Warning>& warnings = model->mesh.warnings;
    scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  }
  scene.intruders.push_back({.name = name, .model = model.get(), .trajectory = trajectory});
}

}  // namespace sigs
