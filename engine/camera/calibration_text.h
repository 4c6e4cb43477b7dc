// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "camera/lens.h"

namespace sigs {

// What a calibration file says.
struct CalibrationText {
  LensParameters lens;
  cv::Size size_px;
  std::string comment;  // one line for people, at the file's head: how the lens was found; may be empty
  std::vector<std::pair<std::string, double>> numbers;  // further values by their keys; those not finite are left out
};

// The calibration as OpenCV FileStorage XML, as OpenCV and read_calibration() read it: image_width, image_height,
// camera_matrix, distortion_coefficients, fisheye_model (0 or 1) or, of a model that OpenCV does not have,
// distortion_model, then the further numbers. It contains neither date
// nor path: the same calibration gives the same bytes. Every number reads back as the same number.
[[nodiscard]] std::string calibration_xml(const CalibrationText& calibration);

}  // namespace sigs
