// SPDX-License-Identifier: MIT
#include "reference/opencv_lens.h"

#include <limits>
#include <opencv2/calib3d.hpp>

#include "base/ensure.h"

namespace sigs::truth {

OpencvLens::OpencvLens(const LensParameters& parameters)
    : parameters_(parameters), matrix_(parameters.fx, 0, parameters.cx, 0, parameters.fy, parameters.cy, 0, 0, 1) {
  if (parameters.model != LensModel::brown_conrady && parameters.model != LensModel::kannala_brandt)
    exact_.emplace(parameters);
}

std::vector<cv::Point2d> OpencvLens::pixels(const std::vector<cv::Point3d>& p_optical) const {
  std::vector<cv::Point2d> pixels;
  if (p_optical.empty()) return pixels;
  const cv::Vec3d none(0, 0, 0);
  if (exact_) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const cv::Point3d& p : p_optical) {
      const auto pixel = exact_->pixel({p.z, p.x, p.y});
      pixels.push_back(pixel ? cv::Point2d(pixel->x, pixel->y) : cv::Point2d(kNan, kNan));
    }
  } else if (parameters_.model == LensModel::kannala_brandt) {
    cv::fisheye::projectPoints(p_optical, pixels, none, none, matrix_, parameters_.coefficients);
  } else {
    cv::projectPoints(p_optical, none, none, matrix_, parameters_.coefficients, pixels);
  }
  return pixels;
}

std::vector<cv::Point2d> OpencvLens::tangents(const std::vector<cv::Point2d>& pixels,
                                              const cv::TermCriteria& criteria) const {
  ENSURE(is_opencvs());
  std::vector<cv::Point2d> tangents;
  if (parameters_.model == LensModel::kannala_brandt)
    cv::fisheye::undistortPoints(pixels, tangents, matrix_, parameters_.coefficients, cv::noArray(), cv::noArray(),
                                 criteria);
  else
    cv::undistortPoints(pixels, tangents, matrix_, parameters_.coefficients, cv::noArray(), cv::noArray(), criteria);
  return tangents;
}

}  // namespace sigs::truth
