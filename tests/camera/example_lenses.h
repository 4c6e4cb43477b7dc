// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "camera/lens.h"

namespace sigs::test {

struct ExampleLens {
  std::string name;
  Lens lens;
  cv::Size size_px;
};

// Lenses with every number of coefficients and every kind of difficulty: folds, poles, tilts, extreme values.
[[nodiscard]] std::vector<ExampleLens> example_lenses();

// All calibrations among the real data; empty where they are absent.
[[nodiscard]] std::vector<ExampleLens> real_lenses();

// example_lenses() and real_lenses().
[[nodiscard]] std::vector<ExampleLens> all_lenses();

// The lens of these parameters, which must be valid.
[[nodiscard]] Lens lens_of(LensModel model, double fx, double fy, glm::dvec2 center, std::vector<double> coefficients);

// Unit direction in the camera frame at an angle from the axis; turn 0 is to the right, a quarter turn is down.
[[nodiscard]] glm::dvec3 direction(double from_axis_rad, double turn_rad);

// Directions over the whole valid field (up to share of its angle), axis first.
[[nodiscard]] std::vector<glm::dvec3> directions_over(const Lens& lens, int rings, int spokes, double share);

// The pixels that OpenCV computes for points in front of the camera, whether or not they lie in the field; of models
// that OpenCV does not have, those of truth::ExactLens.
[[nodiscard]] std::vector<glm::dvec2> opencv_pixels(const Lens& lens, const std::vector<glm::dvec3>& p_in_camera);

// Angle between two directions, good for small ones too.
[[nodiscard]] double angle_between(const glm::dvec3& a, const glm::dvec3& b);

}  // namespace sigs::test
