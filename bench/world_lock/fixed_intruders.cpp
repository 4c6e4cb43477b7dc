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
#include "world_lock/background_point.h"

#include <opencv2/imgproc.hpp>

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

namespace {

constexpr int kMargin_px = 32;
constexpr int kApart_px = 60;
// Mean of the weaker squared gradient, (code values a pixel)^2, above what noise makes of a clear sky.
constexpr double kMinTexture = 0.5;

// Smaller eigenvalue of the mean structure tensor of the neighbourhood, CV_32F; 0 outside of the mask.
cv::Mat texture_of(const cv::Mat& luma, const cv::Mat& mask, cv::Size half_px) {
  cv::Mat smooth, dx, dy, inside;
  cv::GaussianBlur(luma, smooth, {0, 0}, 1);
  cv::Sobel(smooth, dx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(smooth, dy, CV_32F, 0, 1, 3, 0.125);
  mask.convertTo(inside, CV_32F, 1.0 / 255);
  dx = dx.mul(inside);
  dy = dy.mul(inside);
  const cv::Size window(2 * half_px.width + 1, 2 * half_px.height + 1);
  cv::Mat xx, xy, yy, root;
  cv::boxFilter(dx.mul(dx), xx, CV_32F, window);
  cv::boxFilter(dx.mul(dy), xy, CV_32F, window);
  cv::boxFilter(dy.mul(dy), yy, CV_32F, window);
  cv::sqrt((xx - yy).mul(xx - yy) + 4 * xy.mul(xy), root);
  cv::Mat weaker = 0.5 * (xx + yy - root);
  weaker.setTo(0, mask == 0);
  return weaker;
}

}  // namespace

std::vector<cv::Point> places_in(const Clip& clip, int frame, int count, cv::Point shift) {
  const cv::Size size_px = clip.shape.size_px;
  cv::Mat texture =
      texture_of(clip.luma[static_cast<std::size_t>(frame)], clip.world_mask(frame), template_half_px(clip));
  cv::Rect allowed(kMargin_px, kMargin_px, size_px.width - 2 * kMargin_px, size_px.height - 2 * kMargin_px);
  if (!clip.source.far_background.empty()) allowed &= clip.source.far_background + shift;
  cv::Mat outside(size_px, CV_8UC1, cv::Scalar(255));
  outside(allowed).setTo(0);
  texture.setTo(0, outside);
  std::vector<cv::Point> places;
  for (int i = 0; i < count; ++i) {
    double most = 0;
    cv::Point at;
    cv::minMaxLoc(texture, nullptr, &most, nullptr, &at);
    if (most < kMinTexture) break;
    places.push_back(at);
    cv::circle(texture, at, kApart_px, 0, cv::FILLED);
  }
  return places;
}

}  // namespace sigs::bench
