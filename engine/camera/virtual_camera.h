// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "camera/camera.h"
#include "camera/lens_table.h"
#include "camera/pinhole_view.h"

namespace sigs {

// The views in which to draw a body so that the lens can then ask them for its colours.
//   corners_in_camera  the eight corners of a box around the body, metres, camera frame
//   target             pixels that will be asked for; what lies outside is cut off the views. None: the whole body
//   supersampling      drawn pixels an image pixel, each way, where the image (within target) is finest; >= 1
//   max_size_px        largest side of a view; a body that would need more is drawn coarser
// One view that just holds the box where it spans less than about 100 degrees; else the six faces of a cube around the
// camera. Small bodies are drawn at least some 50 pixels large, so that their share of an image pixel is right.
// None where the camera sees no part of the body's surroundings at all.
// Before a pinhole lens with fx == fy the view lies in the image's own plane, a whole number of its pixels to each of
// the image's, edges on edges, as far as supersampling is whole and max_size_px allows: then nothing is resampled.
[[nodiscard]] std::vector<VirtualCamera> virtual_cameras(LensTable& lens,
                                                         const std::array<glm::dvec3, 8>& corners_in_camera,
                                                         const std::optional<cv::Rect>& target, double supersampling,
                                                         int max_size_px);

// The same through a table that is made for this one body.
[[nodiscard]] std::vector<VirtualCamera> virtual_cameras(const Camera& camera,
                                                         const std::array<glm::dvec3, 8>& corners_in_camera,
                                                         const std::optional<cv::Rect>& target, double supersampling,
                                                         int max_size_px);

}  // namespace sigs
