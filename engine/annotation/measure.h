// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>

#include "base/image.h"
#include "base/layer.h"
#include "base/pose.h"
#include "camera/camera.h"

namespace sigs {

// The whole silhouette through the lens.
struct Silhouette {
  Box box;                     // of all points that have an image
  bool all_have_image = true;  // false: some lie behind the camera or beyond the lens' valid field
};

// The smallest box around the images of the points. Nothing where no point has an image.
//   points_in_body  the model's vertices, metres
[[nodiscard]] std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                                      const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                      const Lens& lens);

// A pixel is the intruder's where at least this share of it is covered: what rounds to one code value of a mask.
inline constexpr float kLeastCoverage = 0.5F / 255.0F;

// Smallest box of whole pixels around those covered by at least kLeastCoverage; coverage is CV_32FC1 over rect.
[[nodiscard]] std::optional<cv::Rect> covered_box(const cv::Mat& coverage, const cv::Rect& rect);

// Sum of the coverage, in pixels.
[[nodiscard]] double area_px(const cv::Mat& coverage);

}  // namespace sigs
