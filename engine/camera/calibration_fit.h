// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "camera/lens.h"

namespace sigs::calibration {

// Whether a calibration fits the footage and is plausible: what the file leaves open is assumed, another
// image size is scaled to, and warnings name what is implausible.

// A lens model, and the reason for it where the file does not state one.
struct AssumedModel {
  LensModel model = LensModel::brown_conrady;
  std::string why;  // empty: there is only one model with these coefficients
};

// The model of coefficients for which the file states none. Four can be OpenCV's Brown-Conrady k1 k2 p1 p2 or its
// fisheye k1 k2 k3 k4. The tangential p1 p2 describe a lens that is not parallel to its sensor and are thousandths to
// hundredths: larger ones are taken as fisheye, all else as Brown-Conrady, as in OpenCV's own functions. Four zeros are
// a pinhole.
[[nodiscard]] AssumedModel assumed_model(std::span<const double> coefficients);

// Why a matrix without a stated image size cannot belong to images of this size: its principal point lies outside them.
// Empty where it can.
[[nodiscard]] std::string why_not_made_for(const LensParameters& lens, cv::Size size_px);

// One text for each thing about the intrinsics that is hardly intended: a principal point outside the image or, where
// the file states no size, far from its middle; a field of view below 1 degree or, of a pinhole, above 166, of a
// fisheye above 360.
[[nodiscard]] std::vector<std::string> matrix_warnings(const LensParameters& lens, cv::Size size_px,
                                                       bool size_is_stated);

// The lens of a calibration for images of from_px after they are resized to to_px, each side by its own scale.
// Shapes count as the same where they differ by at most 1 %, as with encoders that require sides of whole blocks
// (848x480 for 853.3x480); otherwise the error names both. Where they differ by more than the rounding of half a pixel,
// a warning states both scales, and how far off the image's edges are if the camera has cropped instead.
//   stretch    how much wider and higher the calibration's images are than the footage (Gyroflow's anamorphic lenses)
//   file_name  for messages
//   warnings   receives the warning
[[nodiscard]] Result<LensParameters> scaled_calibration(LensParameters lens, cv::Size from_px, cv::Size to_px,
                                                        const cv::Point2d& stretch, const std::string& file_name,
                                                        std::vector<Warning>& warnings);

}  // namespace sigs::calibration
