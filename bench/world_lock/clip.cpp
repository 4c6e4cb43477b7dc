// SPDX-License-Identifier: MIT
#include "world_lock/clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "accuracy/csv.h"
#include "base/pose.h"
#include "ego_motion/ego_motion.h"
#include "occlusion/detect.h"
#include "scene/opened_project.h"
#include "telemetry/track.h"

namespace sigs::bench {

namespace {

namespace fs = std::filesystem;

const fs::path kData = SIGS_TEST_DATA;
const fs::path kAssets = SIGS_ASSETS_DIR;
constexpr int kBoxMargin_px = 6;

// Cameras that travel: what lies far off was marked by eye in the first frame. The patches are low, so that they hold
// what stands at the horizon and little of the nearer ground below.
std::vector<ClipSource> travelling() {
  return {{.name = "coast",
           .path = kData / "video/air_karma_gopro_coast.mp4",
           .focal_px = 562.8,
           .far_background = {375, 222, 160, 14},
           .patch_px = {40, 14},
           .has_log = true},
          {.name = "road",
           .path = kData / "video/ground_udacity_road_540p.mp4",
           .far_background = {345, 247, 130, 8},
           .patch_px = {40, 10}},
          {.name = "bonnet",
           .path = kData / "video/ownbody_dashcam_bonnet_360p.mp4",
           .far_background = {290, 155, 80, 14},
           .patch_px = {30, 12},
           .finds_own_body = true}};
}

std::vector<ClipSource> on_the_ground() {
  std::vector<ClipSource> clips{{.name = "tree", .path = kData / "video/opencv_tree.avi"}};
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(kData / "track", ignored)) {
    if (entry.path().extension() != ".mp4") continue;
    const std::string name = entry.path().stem().string();
    clips.push_back(
        {.name = name, .path = entry.path(), .moving_boxes = entry.path().parent_path() / (name + "_gt.csv")});
  }
  std::sort(clips.begin(), clips.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return clips;
}

ClipSource synthetic_clip() {
  return {.name = "synthetic",
          .path = kAssets / "footage/table1_vibration.mp4",
          .calibration = kAssets / "calibrations/sample.xml",
          .far_background = {100, 485, 1080, 30},
          .patch_px = {40, 30},
          .own_body = kAssets / "footage/sample_own_body.png",
          .attitude = kAssets / "footage/table1_vibration_attitude.csv"};
}

// frame,label,x,y,w,h with the first pixel at 1.
std::vector<cv::Rect> boxes_of(const fs::path& file, int frames) {
  std::vector<cv::Rect> boxes(static_cast<std::size_t>(frames));
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    int frame = 0;
    double x = 0, y = 0, width = 0, height = 0;
    if (std::sscanf(line.c_str(), "%d,%*[^,],%lf,%lf,%lf,%lf", &frame, &x, &y, &width, &height) != 5) continue;
    if (frame < 0 || frame >= frames) continue;
    boxes[static_cast<std::size_t>(frame)] = {
        static_cast<int>(x) - 1 - kBoxMargin_px, static_cast<int>(y) - 1 - kBoxMargin_px,
        static_cast<int>(width) + 2 * kBoxMargin_px, static_cast<int>(height) + 2 * kBoxMargin_px};
  }
  return boxes;
}

fs::path written_calibration(const ClipSource& source, cv::Size size_px, const fs::path& folder) {
  const double focal_px =
      source.focal_px > 0 ? source.focal_px : 0.5 * size_px.width / std::tan(0.5 * source.guessed_field_rad);
  const fs::path file = folder / (source.name + " camera.yml");
  cv::FileStorage out(file.string(), cv::FileStorage::WRITE);
  out << "image_width" << size_px.width << "image_height" << size_px.height << "camera_matrix"
      << cv::Mat((cv::Mat_<double>(3, 3) << focal_px, 0, 0.5 * (size_px.width - 1), 0, focal_px,
                  0.5 * (size_px.height - 1), 0, 0, 1))
      << "distortion_coefficients" << cv::Mat(cv::Mat::zeros(1, 5, CV_64F));
  return file;
}

void set_calibration(Clip& clip, const fs::path& folder) {
  const ClipSource& source = clip.source;
  clip.calibration =
      source.calibration.empty() ? written_calibration(source, clip.shape.size_px, folder) : source.calibration;
  Result<Camera> camera = read_calibration(clip.calibration, clip.shape.size_px);
  if (!camera) accuracy::stop(camera.error().text());
  clip.camera = *std::move(camera);
}

cv::Mat found_own_body(FrameSource& footage) {
  const auto body = detect_own_body(footage, 0, {}, {});
  if (!body) accuracy::stop(body.error().text());
  return body->mask;
}

}  // namespace

std::vector<ClipSource> clip_sources() {
  std::vector<ClipSource> clips = travelling();
  const std::vector<ClipSource> ground = on_the_ground();
  clips.insert(clips.end(), ground.begin(), ground.end());
  std::erase_if(clips, [](const ClipSource& clip) { return !fs::exists(clip.path); });
  clips.push_back(synthetic_clip());
  return clips;
}

FrameSource opened(const fs::path& path) {
  Result<FrameSource> source = FrameSource::open(path);
  if (!source) accuracy::stop(source.error().text());
  return *std::move(source);
}

Clip loaded(const ClipSource& source, const fs::path& folder) {
  FrameSource footage = opened(source.path);
  Clip clip{.source = source, .shape = shape_of(footage.info()), .camera = {.lens = *Lens::make({})}};
  for (int n = 0; n < footage.info().frame_count(); ++n) {
    const Result<Frame> frame = footage.read(n);
    if (!frame) accuracy::stop(frame.error().text());
    clip.luma.push_back(frame->planes[0].clone());
  }
  if (!source.moving_boxes.empty()) clip.moving = boxes_of(source.moving_boxes, clip.frame_count());
  if (!source.own_body.empty()) clip.own_body = cv::imread(source.own_body.string(), cv::IMREAD_GRAYSCALE);
  if (source.finds_own_body) clip.own_body = found_own_body(footage);
  if (source.has_log) {
    Result<Track> log = read_track(source.path);
    if (!log) accuracy::stop(log.error().text());
    clip.log = *std::move(log);
  }
  set_calibration(clip, folder);
  return clip;
}

std::string fit_guessed_lens(Clip& clip, const fs::path& folder) {
  ClipSource& source = clip.source;
  if (!source.calibration.empty()) return "calibrated";
  if (source.focal_px > 0) return fmt::format("{:.1f} px a radian", source.focal_px);
  const std::string guess = fmt::format("guessed {:.0f} deg", deg_of_rad(source.guessed_field_rad));
  FrameSource footage = opened(source.path);
  const Result<EgoMotion> motion = estimate_ego_motion(footage, clip.camera, clip.own_body, nullptr, {}, {});
  if (!motion) accuracy::stop(motion.error().text());
  const auto& found = motion->focal_scale;
  if (!found) return guess;
  const double half = std::tan(0.5 * source.guessed_field_rad);
  const auto field_deg = [half](double scale) { return deg_of_rad(2 * std::atan(half / scale)); };
  source.guessed_field_rad = rad_of_deg(field_deg(found->value));
  set_calibration(clip, folder);
  return fmt::format("{:.0f} deg by its turns ({} to {:.0f})", field_deg(found->value),
                     found->largest > 0 ? fmt::format("{:.0f}", field_deg(found->largest)) : "less",
                     field_deg(found->least));
}

cv::Mat Clip::world_mask(int frame) const {
  cv::Mat mask(shape.size_px, CV_8UC1, cv::Scalar(255));
  if (!own_body.empty()) mask.setTo(0, own_body > 0);
  if (!moving.empty()) mask(moving[static_cast<std::size_t>(frame)] & cv::Rect({}, shape.size_px)).setTo(0);
  return mask;
}

}  // namespace sigs::bench
