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

// A lens model, and why it was taken where the file does not say.
struct AssumedModel {
  LensModel model = LensModel::brown_conrady;
  std::string why;  // empty: there was nothing to choose
};

// The model of coefficients that a file states none for. Four can be OpenCV's Brown-Conrady k1 k2 p1 p2 or its fisheye
// k1 k2 k3 k4. The tangential p1 p2 come of a lens that is not parallel to its sensor and are thousandths to
// hundredths: larger ones are taken as fisheye, all else as Brown-Conrady, as OpenCV's own functions do. Four zeros are
// a pinhole.
[[nodiscard]] AssumedModel assumed_model(std::span<const double> coefficients);

// Why a matrix without an image size cannot be one for images of this size: its principal point lies outside of them.
// Empty: it can be.
[[nodiscard]] std::string why_not_made_for(const LensParameters& lens, cv::Size size_px);

// What is hardly meant: a principal point outside the image or, where the file states no size, far from its middle; a
// field of view below 1 degree or, of a pinhole, close to 180, of a fisheye above 360. One text each.
[[nodiscard]] std::vector<std::string> matrix_warnings(const LensParameters& lens, cv::Size size_px,
                                                       bool size_is_stated);

}  // namespace sigs::calibration
