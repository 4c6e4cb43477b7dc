// SPDX-License-Identifier: MIT
#include "world_lock/slip.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "accuracy/csv.h"
#include "frame/compose_frame.h"
#include "world_lock/background_point.h"
#include "world_lock/fixed_intruders.h"

namespace sigs::bench {

namespace {

constexpr int kEnlarged = 8;
constexpr int kGap_px = 6;  // between the pieces of a strip

struct StripSettings {
  int first = 0;
  int every = 60;
  int pieces = 7;
  cv::Size piece_px{56, 44};  // of the footage
  int above_px = 12;          // the intruder over the point of the background
};

// Where the point of the background is in the frames of a strip; ends early where it is lost.
std::vector<cv::Point2d> background_in(const Clip& clip, cv::Point2d at, const StripSettings& settings) {
  std::vector<cv::Point2d> points{at};
  BackgroundPoint point(clip, settings.first, at);
  Pyramid before = pyramid_of(clip.luma[static_cast<std::size_t>(settings.first)]);
  for (int n = 1; n <= settings.every * (settings.pieces - 1); ++n) {
    const std::size_t frame = static_cast<std::size_t>(settings.first + n);
    if (frame >= clip.luma.size()) break;
    Pyramid after = pyramid_of(clip.luma[frame]);
    const auto step = point.next(before, after);
    if (!step) break;
    if (n % settings.every == 0) points.push_back(step->at);
    before = std::move(after);
  }
  return points;
}

cv::Mat composed(const Scene& scene, FrameSource& footage, int frame, ComposeContext& context) {
  const Result<Frame> background = footage.read(frame);
  if (!background) accuracy::stop(background.error().text());
  const Result<ComposedFrame> result = compose_frame(scene, frame, *background, context);
  if (!result) accuracy::stop(result.error().text());
  return bgr_of(result->image);
}

// The neighbourhood of a point, to a fraction of a pixel, enlarged.
cv::Mat enlarged(const cv::Mat& image, cv::Point2d middle, cv::Size piece_px) {
  cv::Mat piece, large;
  cv::getRectSubPix(image, piece_px, middle, piece);
  cv::resize(piece, large, {}, kEnlarged, kEnlarged, cv::INTER_NEAREST);
  return large;
}

// Ticks at the edges, level with the place that the intruder has above the point of the background.
void draw_ticks(cv::Mat& piece, cv::Point at) {
  constexpr int kTick_px = 14, kThick_px = 3;
  const cv::Scalar color(0, 220, 255);
  cv::line(piece, {at.x, 0}, {at.x, kTick_px}, color, kThick_px);
  cv::line(piece, {at.x, piece.rows - 1}, {at.x, piece.rows - 1 - kTick_px}, color, kThick_px);
  cv::line(piece, {0, at.y}, {kTick_px, at.y}, color, kThick_px);
  cv::line(piece, {piece.cols - 1, at.y}, {piece.cols - 1 - kTick_px, at.y}, color, kThick_px);
}

// One row of a strip.
cv::Mat row_of(const Clip& clip, const CameraKnowledge& camera, const Hovering& intruder,
               const std::vector<cv::Point2d>& background, const StripSettings& settings) {
  const Scene scene = scene_with(clip, camera, settings.first, {intruder});
  FrameSource footage = opened(clip.source.path);
  ComposeContext context;
  const cv::Size large_px = settings.piece_px * kEnlarged;
  const int pieces = static_cast<int>(background.size());
  cv::Mat row(large_px.height, pieces * (large_px.width + kGap_px) - kGap_px, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < pieces; ++i) {
    const cv::Mat image = composed(scene, footage, settings.first + i * settings.every, context);
    const cv::Point2d middle = background[static_cast<std::size_t>(i)] - cv::Point2d(0, 0.5 * settings.above_px);
    cv::Mat piece = enlarged(image, middle, settings.piece_px);
    draw_ticks(piece, {large_px.width / 2, large_px.height / 2 - kEnlarged * settings.above_px / 2});
    piece.copyTo(row(cv::Rect({i * (large_px.width + kGap_px), 0}, large_px)));
  }
  return row;
}

cv::Mat strip_of(const Clip& clip, const std::vector<CameraKnowledge>& cameras, double distance_m, cv::Point at,
                 const StripSettings& settings) {
  const std::vector<cv::Point2d> background = background_in(clip, at, settings);
  const Hovering intruder{.pixel = at - cv::Point(0, settings.above_px), .distance_m = distance_m};
  const cv::Mat without = row_of(clip, cameras.front(), intruder, background, settings);
  cv::Mat strip(2 * without.rows + kGap_px, without.cols, CV_8UC3, cv::Scalar::all(255));
  without.copyTo(strip.rowRange(0, without.rows));
  row_of(clip, cameras.back(), intruder, background, settings)
      .copyTo(strip.rowRange(without.rows + kGap_px, strip.rows));
  return strip;
}

Clip clip_by_name(const std::string& name, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const ClipSource& source : clip_sources())
    if (source.name == name) return loaded(source, folder);
  accuracy::stop(name + ": there is no such clip");
}

void write(const std::filesystem::path& file, const cv::Mat& image) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  if (!cv::imwrite(file.string(), image, {cv::IMWRITE_PNG_COMPRESSION, 9}))
    accuracy::stop(file.string() + ": cannot be written");
  std::printf("%s\n", file.c_str());
}

cv::Point best_place(const Clip& clip, int frame) {
  const std::vector<cv::Point> places = places_in(clip, frame, 1);
  if (places.empty()) accuracy::stop(clip.source.name + ": no background with texture enough");
  return places.front();
}

}  // namespace

void draw_strips(const std::string& name, const std::filesystem::path& folder, const std::filesystem::path& images) {
  const Clip clip = clip_by_name(name, folder);
  const std::vector<CameraKnowledge> cameras = knowledge_of(clip, folder);
  const cv::Point at = best_place(clip, 0);
  for (const double distance_m : kDistances_m)
    write(images / (name + " " + std::to_string(static_cast<int>(distance_m)) + " m.png"),
          strip_of(clip, cameras, distance_m, at, {.every = std::min(60, (clip.frame_count() - 1) / 6)}));
}

void draw_figure(const std::filesystem::path& folder, const std::filesystem::path& figure) {
  Clip clip = clip_by_name("synthetic", folder);
  clip.source.far_background = {560, 485, 160, 30};  // straight ahead: the camera travels there, without parallax
  std::vector<CameraKnowledge> cameras = knowledge_of(clip, folder);
  cameras.resize(2);  // constant attitude, and estimated from the images
  const StripSettings settings{.every = 2, .pieces = 6, .piece_px = {40, 32}, .above_px = 10};
  write(figure, strip_of(clip, cameras, 1000, best_place(clip, 0), settings));
}

}  // namespace sigs::bench
