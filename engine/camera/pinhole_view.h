// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <optional>

#include "base/pose.h"

namespace sigs {

// A pinhole camera at the real camera's place, turned towards one intruder and covering no more than it. The intruder
// is drawn in this view; the real lens then asks it for colours, so any lens works, a 170 degree fisheye too.
struct VirtualCamera {
  Pose<frame::View, frame::Camera> view_from_camera;  // a rotation; X along the view's axis, Y right, Z down
  double focal_px = 1;
  glm::dvec2 center_px{0, 0};  // where the axis meets the image, base/image.h's convention
  cv::Size size_px;

  // Pixel of a direction or point given in the camera frame; nothing where it is behind the view.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& p_in_camera) const;
};

}  // namespace sigs
