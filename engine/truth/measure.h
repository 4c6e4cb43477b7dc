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
#include "truth/annotation.h"

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

// A pixel is the intruder's where its coverage is at least this share of what its most covered pixel has: small enough
// for the tips of thin wings. What drawing spills beyond the silhouette's own pixels is larger and cut off apart.
inline constexpr float kMinCoverageShare = 1.0F / 64.0F;

// Nobody sees less than half a code value.
inline constexpr float kMinVisibleCoverage = 0.5F / 255.0F;

// Largest coverage of any pixel, 0 for none. coverage is CV_32FC1.
[[nodiscard]] float max_coverage(const cv::Mat& coverage);

// Smallest box of whole pixels around those covered by at least `min_coverage` and by more than nothing; coverage is
// CV_32FC1 over rect.
[[nodiscard]] std::optional<cv::Rect> covered_box(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage);

// Which pixels of box are covered by at least `min_coverage` and by more than nothing: CV_8UC1 of its size, 255 or 0.
// coverage is CV_32FC1 over rect, which holds box.
[[nodiscard]] cv::Mat covered_pixels(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage,
                                     const cv::Rect& box);

// Where points lie against the level plane through the camera. Nothing given lies on it.
//   up_in_camera  unit vector, away from the ground
[[nodiscard]] HorizonSide horizon_side_of(std::span<const glm::vec3> points_in_body,
                                          const Pose<frame::Camera, frame::Body>& camera_from_body,
                                          const glm::dvec3& up_in_camera);

// Sum of the coverage, in pixels.
[[nodiscard]] double area_px(const cv::Mat& coverage);

}  // namespace sigs
