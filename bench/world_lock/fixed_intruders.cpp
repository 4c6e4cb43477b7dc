// SPDX-License-Identifier: MIT
#include "world_lock/fixed_intruders.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "accuracy/csv.h"
#include "camera/row_motion.h"
#include "first_project/first_project.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"
#include "telemetry/track_csv.h"

namespace sigs::bench {

namespace {

// A light aircraft of 8 m up to 500 m, then an airliner of 39 m; at 10 km eight times as large, for else it would be
// two pixels. Turned by its axes, since what hovers has its nose along world X: it is seen from the side.
ModelSettings model_for(double distance_m) {
  const std::string models = SIGS_ASSETS_DIR "/models/";
  return {.file = models + (distance_m < 500 ? "light-aircraft/light-aircraft.obj" : "airliner/airliner.obj"),
          .forward = "+y",
          .scale = distance_m > 5000 ? 8.0 : 1.0};
}

Project project_of(const Clip& clip, const CameraKnowledge& camera) {
  if (!camera.project.empty()) {
    Result<ReadProject> read = read_project(camera.project);
    if (!read) accuracy::stop(read.error().text());
    read->project.intruders.clear();
    if (!camera.is_locked) {
      read->project.camera.track = {};
      read->project.light = {};  // the sun's direction may need the log's time and place
    }
    return std::move(read->project);
  }
  Project project{.file = "world_lock.json", .name = clip.source.name};
  project.footage.video = clip.source.path.string();
  project.footage.calibration = clip.calibration.string();
  project.camera.track = {.file = camera.track, .incomplete = IncompleteTrackChoice::use};
  project.camera.attitude_file = camera.attitude_file;
  project.camera.readout_s = camera.readout_s;
  project.appearance.psf_sigma_px = 0;
  return project;
}

Scene opened_scene(const Project& project, const Clip& clip) {
  Result<Scene> scene = open_scene(project, clip.shape);
  if (!scene) accuracy::stop(scene.error().text());
  return *std::move(scene);
}

CameraKnowledge estimated(const Clip& clip, const Track* log, double readout_s, const std::filesystem::path& file) {
  FrameSource footage = opened(clip.source.path);
  const Result<EgoMotion> motion =
      estimate_ego_motion(footage, clip.camera, clip.own_body, log, {.readout_s = readout_s}, {});
  if (!motion) accuracy::stop(motion.error().text());
  for (const Warning& warning : motion->warnings) std::fprintf(stderr, "%s\n", warning.text().c_str());
  std::ofstream(file) << track_csv_text(track_of(*motion, clip.source.path));
  const auto lost =
      std::count_if(motion->frames.begin(), motion->frames.end(), [](const EgoFrame& frame) { return frame.is_lost; });
  return {.name = log != nullptr ? "images and gyroscope" : "images",
          .track = file.string(),
          .readout_s = readout_s,
          .lost_frames = static_cast<int>(lost),
          .gyro = motion->gyro};
}

}  // namespace

std::vector<CameraKnowledge> knowledge_of(const Clip& clip, const std::filesystem::path& folder) {
  const double readout_s = clip.log ? clip.log->readout_s.value_or(0) : 0;
  const std::filesystem::path stem = std::filesystem::absolute(folder / clip.source.name);
  std::vector<CameraKnowledge> all{{.name = "constant attitude"}};
  all.push_back(estimated(clip, nullptr, readout_s, stem.string() + " images.csv"));
  if (clip.log) all.push_back(estimated(clip, &*clip.log, readout_s, stem.string() + " gyroscope.csv"));
  if (!clip.source.attitude.empty())
    all.push_back({.name = "true attitude", .attitude_file = clip.source.attitude.string()});
  return all;
}

InitKnowledge init_knowledge_of(const Clip& clip, const std::filesystem::path& folder) {
  const std::filesystem::path file =
      std::filesystem::absolute(folder / "init" / clip.source.name / (clip.source.name + ".json"));
  const Result<FirstProject> made =
      make_first_project({.video = clip.source.path, .timing = {}, .out = file, .overwrite = true}, {});
  if (!made) accuracy::stop(made.error().text());
  InitKnowledge init{.cameras = {{.name = "init without lock", .project = file, .is_locked = false},
                                 {.name = "init", .project = file}},
                     .said = {}};
  for (const FirstProjectNote& note : made->notes)
    if (note.field == "camera.track.file" || note.field == "camera.speed_mps")
      init.said += (init.said.empty() ? "" : "; ") + note.text;
  return init;
}

Scene scene_with(const Clip& clip, const CameraKnowledge& camera, int frame, const std::vector<Hovering>& intruders) {
  Project project = project_of(clip, camera);
  const Scene empty = opened_scene(project, clip);
  const auto world_from_camera = camera_at(empty.motion, clip.shape.times_s[static_cast<std::size_t>(frame)]);
  for (const Hovering& hovering : intruders) {
    const auto ray = empty.camera.lens.ray({hovering.pixel.x, hovering.pixel.y});
    if (!ray) accuracy::stop(clip.source.name + ": an intruder's pixel has no ray");
    IntruderSettings intruder{.model = model_for(hovering.distance_m)};
    intruder.trajectory.waypoints = {{.position_m = world_from_camera * (*ray * hovering.distance_m)}};
    project.intruders.push_back(std::move(intruder));
  }
  return opened_scene(project, clip);
}

std::optional<cv::Point2d> pixel_of(const Scene& scene, std::size_t intruder, int frame) {
  const double time_s = scene.footage.times_s[static_cast<std::size_t>(frame)];
  const auto pose_at = [&](double later_s) { return camera_from_body_at(scene, intruder, time_s + later_s); };
  const auto pixel = scene.motion.readout_s > 0
                         ? RowMotion(pose_at, scene.footage.size_px.height, scene.motion.readout_s)
                               .pixel(scene.camera.lens, glm::dvec3(0))
                         : scene.camera.lens.pixel(pose_at(0).translation_m);
  if (!pixel) return std::nullopt;
  return cv::Point2d(pixel->x, pixel->y);
}

}  // namespace sigs::bench
