// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "camera/camera.h"
#include "camera/lens_table.h"

namespace sigs {

// A pinhole camera at the real camera's position, rotated towards one intruder and no larger than the intruder needs.
// The intruder is rendered in this view; the real lens then samples it, so that any lens works, also a fisheye of 170
// degrees.
struct VirtualCamera {
  Pose<frame::View, frame::Camera> view_from_camera;  // a rotation; X along the view's axis, Y right, Z down
  double focal_px = 1;
  glm::dvec2 center_px{0, 0};  // principal point, in the pixel convention of base/image.h
  cv::Size size_px;

  // Pixel of a direction or point given in the camera frame; nothing where it lies behind the view.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& p_in_camera) const;
};

// The views in which to render a body so that the lens can then sample its colours.
//   corners_in_camera  the eight corners of a box around the body, metres, camera frame
//   target             image pixels that will be sampled; the views leave out what lies outside. None: the whole body
//   supersampling      rendered pixels per image pixel, each way, where the image (within target) is finest; >= 1
//   max_size_px        largest side of a view, >= 64; a body that would need more is rendered coarser
// The result is one view that just contains the box where the box spans less than about 100 degrees, else the faces of
// a cube around the camera that are sampled. It is empty where the camera can see nothing of the body's surroundings.
// Small bodies are rendered at least some 128 pixels large, so that their coverage of an image pixel is accurate.
// For a pinhole lens with fx == fy the view lies in the image's own plane, with a whole number of its pixels to each
// image pixel and edges on edges, as far as max_size_px allows: then no resampling takes place.
[[nodiscard]] std::vector<VirtualCamera> virtual_cameras(LensTable& lens,
                                                         const std::array<glm::dvec3, 8>& corners_in_camera,
                                                         const std::optional<cv::Rect>& target, double supersampling,
                                                         int max_size_px);

// The same with a table that is made for this one body.
[[nodiscard]] std::vector<VirtualCamera> virtual_cameras(const Camera& camera,
                                                         const std::array<glm::dvec3, 8>& corners_in_camera,
                                                         const std::optional<cv::Rect>& target, double supersampling,
                                                         int max_size_px);

}  // namespace sigs
