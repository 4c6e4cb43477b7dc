// SPDX-License-Identifier: MIT
#include "editor/views/viewport/footage_camera.h"

#include <algorithm>
#include <cmath>

#include "editor/views/waypoint_actions.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/zoomable_image.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

Lens lens_of(const Scene& scene) {
  if (scene.compositing.method != MethodChoice::plain) return scene.camera.lens;
  const LensParameters& lens = scene.camera.lens.parameters();
  return Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}).value_or(scene.camera.lens);
}

}  // namespace

std::optional<FootageCamera> footage_camera_at(const ViewContext& context, int frame) {
  if (!context.shown.scene) return std::nullopt;
  const Scene& scene = context.shown.scene->draft.scene;
  return FootageCamera{frame, camera_at(scene.motion, time_of_frame_s(scene.footage, frame)), lens_of(scene)};
}

const std::vector<WaypointMark>& WaypointMarks::of(const ViewContext& context, const FootageCamera& eye) {
  const MadeFor wanted{context.document.revision().number, context.shown.scene ? context.shown.scene->revision : 0,
                       eye.frame};
  if (wanted == made_for_) return marks_;
  made_for_ = wanted;
  marks_.clear();
  const std::vector<IntruderSettings>& intruders = context.project().intruders;
  for (std::size_t i = 0; i < intruders.size(); ++i) {
    const std::vector<double> frames = frames_of_waypoints(context, static_cast<int>(i));
    const std::vector<WaypointSettings>& waypoints = intruders[i].trajectory.waypoints;
    for (std::size_t k = 0; k < waypoints.size() && k < frames.size(); ++k) {
      const std::optional<glm::dvec2> pixel = pixel_of(waypoints[k].position_m, eye.world_from_camera, eye.lens);
      if (pixel)
        marks_.push_back({static_cast<int>(i), static_cast<int>(k), frames[k], waypoints[k].position_m, *pixel});
    }
  }
  return marks_;
}

std::optional<int> project_intruder(const ViewContext& context, int in_scene) {
  if (!context.shown.scene) return std::nullopt;
  const std::vector<int>& numbers = context.shown.scene->draft.intruder_of_project;
  for (std::size_t i = 0; i < numbers.size() && i < context.project().intruders.size(); ++i)
    if (numbers[i] == in_scene) return static_cast<int>(i);
  return std::nullopt;
}

std::optional<int> scene_intruder(const ViewContext& context, int in_project) {
  if (!context.shown.scene || in_project < 0) return std::nullopt;
  const std::vector<int>& numbers = context.shown.scene->draft.intruder_of_project;
  const auto index = static_cast<std::size_t>(in_project);
  if (index >= numbers.size() || numbers[index] < 0) return std::nullopt;
  return numbers[index];
}

namespace {

constexpr int kFramesBetweenCorners = 25;  // the path's own corners are not known here where speed is constant

glm::dvec2 size_of(const cv::Size& size) {
  return {size.width, size.height};
}

// Moments from one frame to another; one alone where they are the same.
std::vector<double> times_between(const FootageShape& footage, int from, int to) {
  std::vector<double> times;
  for (int frame = from; frame < to; frame += kFramesBetweenCorners) times.push_back(time_of_frame_s(footage, frame));
  times.push_back(time_of_frame_s(footage, to));
  return times;
}

void draw_lines(const ImageCanvas& canvas, const std::vector<PixelLine>& lines, ImU32 color, float thick) {
  std::vector<ImVec2> points;
  for (const PixelLine& line : lines) {
    points.clear();
    for (const glm::dvec2& pixel : line) points.push_back(im(canvas.view.screen_of(pixel)));
    canvas.draw.AddPolyline(points.data(), static_cast<int>(points.size()), color, ImDrawFlags_None, thick);
  }
}

}  // namespace

void PathOverlay::make(const Scene& scene, const FootageCamera& eye) {
  pieces_.clear();
  const int here = std::clamp(eye.frame, scene.first_frame, scene.last_frame);
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
    const Trajectory& trajectory = scene.intruders[i].trajectory;
    const auto add = [&](int from, int to, bool past) {
      const std::vector<double> times = times_between(scene.footage, from, to);
      if (times.size() < 2) return;
      const auto position = [&](double time_s) { return trajectory.position_m(time_s); };
      pieces_.push_back(
          {static_cast<int>(i), past,
           path_through_lens(position, times, eye.world_from_camera, eye.lens, size_of(scene.footage.size_px))});
    };
    add(scene.first_frame, here, true);
    add(here, scene.last_frame, false);
  }
}

void PathOverlay::draw(const ImageCanvas& canvas, const ViewContext& context, const FootageCamera& eye) {
  if (!context.shown.scene) return;
  const OpenedScene& opened = *context.shown.scene;
  if (scene_ != opened.revision || frame_ != eye.frame) make(opened.draft.scene, eye);
  scene_ = opened.revision;
  frame_ = eye.frame;
  const std::optional<int> current = current_intruder(context);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (const PathPiece& piece : pieces_) {
    const std::optional<int> intruder = project_intruder(context, piece.intruder);
    const bool worked_on = intruder && current == intruder;
    const double opacity = (piece.past ? 0.4 : 0.95) * (worked_on ? 1 : 0.6);
    draw_lines(canvas, piece.lines, faded(intruder_color(intruder.value_or(0)), opacity), scaled(worked_on ? 2 : 1.3));
  }
  canvas.draw.PopClipRect();
}

void draw_horizon(const ImageCanvas& canvas, const FootageCamera& eye) {
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  draw_lines(canvas, horizon_through_lens(eye.world_from_camera, eye.lens, size_of(canvas.image_px)), color::kHorizon,
             scaled(1.4));
  canvas.draw.PopClipRect();
}

}  // namespace sigs::editor
