// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "base/result.h"
#include "mesh/mesh.h"
#include "render/renderer.h"

namespace sigs::editor {

// A model by itself: seen three-quarters from the front and slightly above, turned by turn_rad about its vertical
// (positive to the right, as yaw), lit from the left above, filling the image whatever its size. At turn 0 its nose
// points towards the viewer and to the right. CV_8UC4, RGBA, straight alpha, display code values; 4 samples a pixel.
[[nodiscard]] Result<cv::Mat> turntable_image(const Mesh& mesh, double turn_rad, cv::Size size_px, Renderer& renderer);

// Where a direction in body axes (x nose, y right wing, z belly) ends in that image, in pixels: from the middle of
// the model's bounds, as long as the sphere around them is wide to one side.
[[nodiscard]] glm::dvec2 turntable_point_px(const glm::dvec3& direction_in_body, double turn_rad, cv::Size size_px);

// Premultiplied linear RGBA (CV_32FC4) as straight display RGBA (CV_8UC4). What is wholly transparent is black.
[[nodiscard]] cv::Mat straight_display(const cv::Mat& premultiplied);

}  // namespace sigs::editor
