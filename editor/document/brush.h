// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

namespace sigs::editor {

// A round brush for masks, in pixels of the image. It covers a pixel wholly where the pixel's centre lies up to
// radius_px - edge_px / 2 from its middle, not at all from radius_px + edge_px / 2 on, linearly between; with edge_px 0
// wholly up to radius_px.
struct Brush {
  double radius_px = 20;
  double edge_px = 1;
  bool erases = false;
};

inline constexpr double kMinRadius_px = 0.5;
inline constexpr double kMaxRadius_px = 500;

// 0..1 at a distance from the brush's middle.
[[nodiscard]] double covered(const Brush& brush, double distance_px);

// Moves the brush over a mask (CV_8UC1) in a straight line; a line of no length is a dot. What is covered becomes no
// less than that share of 255, or, where the brush erases, no more than the rest: passing twice changes nothing more.
// The pixels that may have changed; empty where the brush stays beside the image or a number is not finite.
cv::Rect move_brush(cv::Mat& mask, const Brush& brush, const glm::dvec2& from, const glm::dvec2& to);

// The next larger (steps > 0) or smaller radius, within the limits.
[[nodiscard]] double stepped_radius_px(double radius_px, int steps);

}  // namespace sigs::editor
