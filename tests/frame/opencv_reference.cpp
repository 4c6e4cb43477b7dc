// SPDX-License-Identifier: MIT
#include "frame/opencv_reference.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <utility>

#include "reference/opencv_lens.h"

namespace sigs::test {

namespace {

cv::Matx33d about(const cv::Vec3d& axis, double angle_deg) {
  cv::Matx33d rotation;
  cv::Rodrigues(axis * (angle_deg * CV_PI / 180.0), rotation);
  return rotation;
}

// The last one is kept: an exact lens takes some 30 ms to make.
const truth::OpencvLens& reference_of(const LensParameters& lens) {
  static std::optional<std::pair<LensParameters, truth::OpencvLens>> last;
  if (!last || last->first != lens) last.emplace(lens, truth::OpencvLens(lens));
  return last->second;
}

}  // namespace

cv::Matx33d turned(double roll_deg, double pitch_deg, double yaw_deg) {
  return about({0, 0, 1}, yaw_deg) * about({0, 1, 0}, pitch_deg) * about({1, 0, 0}, roll_deg);
}

cv::Matx33d flying_along(const cv::Vec3d& direction) {
  const cv::Vec3d nose = cv::normalize(direction);
  const cv::Vec3d right = cv::normalize(cv::Vec3d(0, 0, 1).cross(nose));
  const cv::Vec3d down = nose.cross(right);
  return {nose[0], right[0], down[0], nose[1], right[1], down[1], nose[2], right[2], down[2]};
}

std::vector<cv::Point3d> optical(const std::vector<cv::Vec3d>& points_in_camera) {
  std::vector<cv::Point3d> points;
  for (const cv::Vec3d& p : points_in_camera) points.emplace_back(p[1], p[2], p[0]);
  return points;
}

double projects_up_to_rad(const LensParameters& lens) {
  return reference_of(lens).is_opencvs() ? CV_PI / 2 : CV_PI;
}

std::vector<cv::Point2d> projected(const LensParameters& lens, const std::vector<cv::Point3d>& points) {
  return reference_of(lens).pixels(points);
}

cv::Rect2d around(const std::vector<cv::Point2d>& pixels) {
  cv::Point2d low = pixels.front();
  cv::Point2d high = pixels.front();
  for (const cv::Point2d& p : pixels) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low, high};
}

cv::Rect touched(const cv::Rect2d& box) {
  const auto pixel = [](double edge) { return static_cast<int>(std::floor(edge + 0.5)); };
  return {cv::Point(pixel(box.x), pixel(box.y)),
          cv::Point(pixel(box.x + box.width) + 1, pixel(box.y + box.height) + 1)};
}

}  // namespace sigs::test
