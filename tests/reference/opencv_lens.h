// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "camera/lens.h"
#include "reference/exact_lens.h"

namespace sigs::truth {

// A lens by OpenCV's own functions or, where OpenCV does not have its model, by ExactLens.
class OpencvLens {
 public:
  explicit OpencvLens(const LensParameters& parameters);

  [[nodiscard]] bool is_opencvs() const { return !exact_; }

  // Pixels of points in the optical frame (x right, y down, z forward). OpenCV gives pixels beyond the valid field too;
  // ExactLens NaN.
  [[nodiscard]] std::vector<cv::Point2d> pixels(const std::vector<cv::Point3d>& p_optical) const;

  // (x / z, y / z) of pixels by cv::undistortPoints and its like; only where is_opencvs().
  [[nodiscard]] std::vector<cv::Point2d> tangents(const std::vector<cv::Point2d>& pixels,
                                                  const cv::TermCriteria& criteria) const;

 private:
  LensParameters parameters_;
  cv::Matx33d matrix_;
  std::optional<ExactLens<double>> exact_;
};

}  // namespace sigs::truth
