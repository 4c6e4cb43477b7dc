// SPDX-License-Identifier: MIT
#include "truth/measure.h"

#include <algorithm>
#include <limits>

namespace sigs {

std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                        const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec2 low(kInfinity);
  glm::dvec2 high(-kInfinity);
  bool all_have_image = true;
  for (const glm::vec3& point : points_in_body) {
    const std::optional<glm::dvec2> pixel = lens.pixel(camera_from_body * glm::dvec3(point));
    if (!pixel) {
      all_have_image = false;
      continue;
    }
    low = glm::min(low, *pixel);
    high = glm::max(high, *pixel);
  }
  if (low.x > high.x) return std::nullopt;
  return Silhouette{{low.x, low.y, high.x - low.x, high.y - low.y}, all_have_image};
}

float max_coverage(const cv::Mat& coverage) {
  if (coverage.empty()) return 0;
  double largest = 0;
  cv::minMaxIdx(coverage, nullptr, &largest);
  return static_cast<float>(largest);
}

std::optional<cv::Rect> covered_box(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage) {
  cv::Point low(rect.width, rect.height);
  cv::Point high(-1, -1);
  for (int j = 0; j < rect.height; ++j)
    for (int i = 0; i < rect.width; ++i) {
      const float covered = coverage.at<float>(j, i);
      if (covered < min_coverage || covered <= 0) continue;
      low = {std::min(low.x, i), std::min(low.y, j)};
      high = {std::max(high.x, i), std::max(high.y, j)};
    }
  if (high.x < 0) return std::nullopt;
  return cv::Rect(low + rect.tl(), high + rect.tl() + cv::Point(1, 1));
}

cv::Mat covered_pixels(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage, const cv::Rect& box) {
  const cv::Mat within = coverage(box - rect.tl());
  return (within >= min_coverage) & (within > 0);
}

HorizonSide horizon_side_of(std::span<const glm::vec3> points_in_body,
                            const Pose<frame::Camera, frame::Body>& camera_from_body, const glm::dvec3& up_in_camera) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double lowest_m = kInfinity;
  double highest_m = -kInfinity;
  for (const glm::vec3& point : points_in_body) {
    const double height_m = glm::dot(up_in_camera, camera_from_body * glm::dvec3(point));
    lowest_m = std::min(lowest_m, height_m);
    highest_m = std::max(highest_m, height_m);
  }
  if (lowest_m > 0 && !points_in_body.empty()) return HorizonSide::above;
  if (highest_m < 0 && !points_in_body.empty()) return HorizonSide::below;
  return HorizonSide::on;
}

double area_px(const cv::Mat& coverage) {
  return coverage.empty() ? 0.0 : cv::sum(coverage)[0];
}

}  // namespace sigs
