// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "frame/compose_frame.h"
#include "frame/synthetic_scenes.h"

namespace sigs::test {

// Every number finite, every share within 0 to 1, every box with a size, every text of a file that should be a number
// is one. Each fault is a failed check that names it and its place.

//   brightest  no surface emits more light than this, 1 for a white light of full strength on a matt surface
void check_valid(const Layer& layer, double brightest);
void check_valid(const IntruderTruth& truth, cv::Size image_size_px);

// Also the very text of the annotation file: each attribute that holds a number is read back.
void check_valid(const FrameTruth& truth, cv::Size image_size_px);

// A frame with all its layers and stages.
struct ValidFrame {
  ComposedFrame composed;
  std::vector<IntruderLayers> layers;  // far to near
};

// Composes the frame and checks everything that comes out: each layer, image, mask, truth and XML. Where the mask is
// 0 the luma has the background's bits.
[[nodiscard]] ValidFrame valid_frame(const Scene& scene, int frame, const Frame& background);

// The lens of the scenario becomes this one.
void set_lens(Scenario& scenario, const cv::Matx33d& matrix, const std::vector<double>& coefficients,
              bool is_fisheye = false);

// A flat plate across the line of sight: side by side metres, white, facing against world X.
void add_plate(Scenario& scenario, double side_m, const glm::dvec3& p_in_world);

// A cube that looks the same from six sides.
void add_cube(Scenario& scenario, double side_m, const glm::dvec3& p_in_world);

// The camera stands here in every scenario.
inline constexpr glm::dvec3 kEye_m{0, 0, -150};

// Sum of the opacity, in pixels.
[[nodiscard]] double opacity_px(const Layer& layer);

}  // namespace sigs::test
