// SPDX-License-Identifier: MIT
#include "editor/preview/thumbnails.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "base/pose.h"
#include "base/threads.h"
#include "base/transfer.h"
#include "export/export_project.h"
#include "first_project/first_model.h"
#include "frame/compose_frame.h"
#include "project/json.h"
#include "project/project.h"
#include "scene/opened_project.h"
#include "scene/scene.h"
#include "scene/visibility.h"
#include "video/frame_source.h"

namespace sigs::editor {

namespace {

constexpr double kFrom_deg = 145;  // 180: straight at the viewer
constexpr double kAbove_deg = 18;
constexpr double kDistance = 4;    // radii of the model: a mild perspective
constexpr int kSupersampling = 3;  // each way: the renderer takes one sample a pixel
constexpr double kFilled = 0.96;   // of the image's half side, by the sphere around the model

struct Ball {
  glm::dvec3 center_m{0, 0, 0};
  double radius_m = 1;
};

Ball ball_around(const Mesh& mesh) {
  const glm::dvec3 low(mesh.low_m);
  const glm::dvec3 high(mesh.high_m);
  return {(low + high) / 2.0, std::max(glm::length(high - low) / 2, 1e-6)};
}

// Looking down at the model means that it is turned nose up before a level camera.
Pose<frame::Camera, frame::Body> placed(const Ball& ball, double turn_rad) {
  const glm::dquat looking_down = rotation_of({.pitch_rad = -rad_of_deg(kAbove_deg)});
  const glm::dquat turned = rotation_of({.yaw_rad = rad_of_deg(kFrom_deg) + turn_rad});
  const glm::dquat camera_from_body = glm::conjugate(looking_down) * turned;
  const glm::dvec3 center(kDistance * ball.radius_m, 0, 0);
  return {camera_from_body, center - camera_from_body * ball.center_m};
}

VirtualCamera view_of(cv::Size size_px) {
  const double half_px = 0.5 * std::min(size_px.width, size_px.height);
  const double tangent = 1 / std::sqrt(kDistance * kDistance - 1);  // of the ball's half angle
  return {.view_from_camera = {},
          .focal_px = kFilled * half_px / tangent,
          .center_px = {0.5 * (size_px.width - 1), 0.5 * (size_px.height - 1)},
          .size_px = size_px};
}

namespace fs = std::filesystem;

constexpr int kFramesLookedAt = 40;
constexpr double kMaxSize = 0.3;  // of the image's width: beyond it the landscape is hardly seen
constexpr double kAround = 5;     // times the intruder's size

bool is_whole(const Box& box, cv::Size size_px) {
  return box.x > 0 && box.y > 0 && box.x + box.width < size_px.width && box.y + box.height < size_px.height;
}

// The largest view of an intruder that lies in the image as a whole.
std::optional<VisibilityEstimate> best_view(const Scene& scene) {
  const VisibilityEstimator points(scene);
  const cv::Size size_px = scene.footage.size_px;
  std::optional<VisibilityEstimate> best;
  for (int i = 0; i < kFramesLookedAt; ++i) {
    const int frame = scene.first_frame + (scene.last_frame - scene.first_frame) * i / (kFramesLookedAt - 1);
    for (int intruder = 0; intruder < static_cast<int>(scene.intruders.size()); ++intruder) {
      const VisibilityEstimate view = points.at(intruder, frame);
      if (view.visibility_state != VisibilityState::in_view || !view.silhouette || !is_whole(*view.silhouette, size_px))
        continue;
      if (view.size_px > kMaxSize * size_px.width || (best && view.size_px <= best->size_px)) continue;
      best = view;
    }
  }
  return best;
}

// Of the wanted shape, within the image, as wide as that many pixels.
cv::Rect window_around(cv::Point2d center, double width, cv::Size image, cv::Size shape) {
  const double aspect = double(shape.height) / shape.width;
  const double maximum = std::min<double>(image.width, image.height / aspect);
  const double w = std::clamp(width, std::min<double>(maximum, shape.width), maximum);
  const double h = w * aspect;
  const cv::Rect window(static_cast<int>(std::clamp(center.x - w / 2, 0.0, image.width - w)),
                        static_cast<int>(std::clamp(center.y - h / 2, 0.0, image.height - h)),
                        std::max(1, static_cast<int>(w)), std::max(1, static_cast<int>(h)));
  return window & cv::Rect({0, 0}, image);
}

cv::Mat scaled_piece(const cv::Mat& bgr, const cv::Rect& window, cv::Size size_px) {
  cv::Mat image;
  cv::resize(bgr(window), image, size_px, 0, 0, cv::INTER_AREA);
  return image;
}

Result<cv::Mat> untouched_image(FrameSource& source, cv::Size size_px) {
  const Result<Frame> frame = source.read(source.info().frame_count() / 2);
  if (!frame) return fail(frame.error());
  const cv::Mat bgr = bgr_of(*frame);
  return scaled_piece(bgr, window_around({bgr.cols / 2.0, bgr.rows / 2.0}, bgr.cols, bgr.size(), size_px), size_px);
}

Result<cv::Mat> composed_image(const Scene& scene, FrameSource& source, cv::Size size_px, ComposeContext& context) {
  const std::optional<VisibilityEstimate> view = best_view(scene);
  if (!view) return fail("", "no intruder comes into view");
  Result<Frame> background = source.read(view->frame);
  if (!background) return fail(background.error());
  const Result<ComposedFrame> composed = compose_frame(scene, view->frame, std::move(*background), context);
  for (const auto& model : scene.models) context.forget(model->mesh);
  if (!composed) return fail(composed.error());
  const cv::Mat bgr = bgr_of(composed->image);
  const Box& box = *view->silhouette;
  const cv::Rect window =
      window_around({box.x + box.width / 2, box.y + box.height / 2}, kAround * view->size_px, bgr.size(), size_px);
  return scaled_piece(bgr, window, size_px);
}

// What is seen of an image of a model, as large as the wanted size allows.
cv::Mat filling(const cv::Mat& rgba, cv::Size size_px) {
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  const cv::Rect seen = cv::boundingRect(alpha);
  if (seen.empty()) return cv::Mat(size_px, CV_8UC4, cv::Scalar::all(0));
  constexpr double kMargin = 0.06;  // of the size, on each side
  const double scale =
      (1 - 2 * kMargin) * std::min(double(size_px.width) / seen.width, double(size_px.height) / seen.height);
  cv::Mat piece;
  cv::resize(rgba(seen), piece, {std::max(1, int(seen.width * scale)), std::max(1, int(seen.height * scale))}, 0, 0,
             cv::INTER_AREA);
  cv::Mat image(size_px, CV_8UC4, cv::Scalar::all(0));
  piece.copyTo(
      image(cv::Rect((size_px.width - piece.cols) / 2, (size_px.height - piece.rows) / 2, piece.cols, piece.rows)));
  return image;
}

}  // namespace

cv::Mat straight_display(const cv::Mat& premultiplied) {
  cv::Mat straight(premultiplied.size(), CV_8UC4);
  for (int y = 0; y < straight.rows; ++y)
    for (int x = 0; x < straight.cols; ++x) {
      const cv::Vec4f& color = premultiplied.at<cv::Vec4f>(y, x);
      const float opacity = color[3];
      cv::Vec4b& out = straight.at<cv::Vec4b>(y, x);
      for (int c = 0; c < 3; ++c)
        out[c] = opacity > 0 ? cv::saturate_cast<uchar>(255.0F * display_of_linear(color[c] / opacity)) : uchar{0};
      out[3] = cv::saturate_cast<uchar>(255.0F * opacity);
    }
  return straight;
}

glm::dvec2 turntable_point_px(const glm::dvec3& direction_in_body, double turn_rad, cv::Size size_px) {
  const VirtualCamera view = view_of(size_px);
  const glm::dvec3 p = placed(Ball{}, turn_rad) * direction_in_body;  // x ahead, y right, z down
  return view.center_px + view.focal_px * glm::dvec2(p.y, p.z) / p.x;
}

Result<cv::Mat> turntable_image(const Mesh& mesh, double turn_rad, cv::Size size_px, Renderer& renderer) {
  const Ball ball = ball_around(mesh);
  const Light light{.p_in_camera = glm::dvec3(-1, -3, -4) * (kDistance * ball.radius_m)};
  const Result<Layer> layer = renderer.draw(mesh, placed(ball, turn_rad), light, view_of(size_px * kSupersampling));
  if (!layer) return fail(layer.error());
  if (layer->empty()) return cv::Mat();
  cv::Mat color;
  cv::resize(layer->color, color, size_px, 0, 0, cv::INTER_AREA);
  return straight_display(color);
}

Result<cv::Mat> project_thumbnail(const fs::path& project_file, cv::Size size_px, ComposeContext& compose) {
  const Result<ReadProject> read = read_project(project_file);
  if (!read) return fail(read.error());
  const Project project = seen_by_each(read->project).front();
  Result<FrameSource> source = open_footage(project);
  if (!source) return fail(source.error());
  if (const Result<Scene> scene = open_scene(project, footage_shape(project, source->info())))
    if (Result<cv::Mat> image = composed_image(*scene, *source, size_px, compose)) return image;
  return untouched_image(*source, size_px);
}

Result<cv::Mat> model_thumbnail(const fs::path& file, cv::Size size_px, ComposeContext& compose) {
  SceneFiles files;
  const Result<FirstModel> model = is_sample_model(file) ? sample_model(file, files) : users_model(file, files);
  if (!model) return fail(model.error());
  const Result<Renderer*> renderer = compose.renderer();
  if (!renderer) return fail(renderer.error());
  const int side_px = 2 * std::max(size_px.width, size_px.height);
  const Result<cv::Mat> rgba = turntable_image(model->model->mesh, 0, {side_px, side_px}, **renderer);
  compose.forget(model->model->mesh);
  if (!rgba || rgba->empty()) return rgba;
  return filling(*rgba, size_px);
}

Thumbnails::Thumbnails(cv::Size size_px, std::function<void()> wake, Make make)
    : size_px_(size_px), wake_(std::move(wake)), make_(std::move(make)) {}

Thumbnails::~Thumbnails() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  asked_.notify_all();
  if (thread_.joinable()) thread_.join();
}

std::shared_ptr<const cv::Mat> Thumbnails::of(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  if (rests_ && !images_.contains(file)) return nullptr;
  const auto [place, is_new] = images_.try_emplace(file);
  if (!is_new) return place->second;
  queue_.push_back(file);
  if (!thread_.joinable())  // without a thread there are no images; the next question tries again
    if (Result<std::thread> thread = started_thread([this] { work(); })) thread_ = std::move(*thread);
  asked_.notify_one();
  return nullptr;
}

void Thumbnails::rest(bool rests) {
  const std::lock_guard lock(mutex_);
  rests_ = rests;
  if (!rests_) return;
  for (const fs::path& file : queue_) images_.erase(file);
  queue_.clear();
}

void Thumbnails::work() {
  ComposeContext compose;  // one renderer for all images: making it takes longer than most of them
  for (;;) {
    fs::path file;
    {
      std::unique_lock lock(mutex_);
      asked_.wait(lock, [this] { return stop_ || !queue_.empty(); });
      if (stop_) return;
      file = std::move(queue_.front());
      queue_.pop_front();
    }
    const Result<void> made = guarded([&]() -> Result<void> {
      Result<cv::Mat> image = make_(file, size_px_, compose);
      if (!image) return fail(image.error());
      const std::lock_guard lock(mutex_);
      images_[file] = std::make_shared<const cv::Mat>(std::move(*image));
      return {};
    });
    if (made) wake_();
  }
}

}  // namespace sigs::editor
