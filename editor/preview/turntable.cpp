// SPDX-License-Identifier: MIT
#include "editor/preview/turntable.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/pose.h"
#include "base/transfer.h"

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

}  // namespace sigs::editor
