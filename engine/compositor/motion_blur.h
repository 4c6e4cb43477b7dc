// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "base/image.h"

namespace sigs {

// Motions below this are left out: their variance, 2e-4 px^2, is a thousandth of that of a sharp pixel.
inline constexpr double kMinMotion_px = 0.05;

// Longer motions are blurred over this length, along their direction: what streaks farther is hardly visible.
inline constexpr double kMaxMotion_px = 200;

// Where a body that moves straight at constant speed during the exposure leaves its light: a line of the motion's
// length, centred, as weights of shifts by whole pixels. The weights are not negative and sum to one. Along the axis of
// the larger component (the major axis) they are a box whose variance is that of the line, length^2 / 12, also for a
// fraction of a pixel. Across it each shift is shared by the two nearest pixels, which keeps the direction exactly but
// spreads light across the line by up to half a pixel: spread_px2 says by how much, and the lens' blur that follows can
// have so much less (blurred_within).
struct MotionKernel {
  struct Shift {
    cv::Point by_px;
    float weight = 0;
  };
  std::vector<Shift> shifts;    // empty: no motion
  cv::Size margin_px;           // largest shift along each axis
  glm::dvec2 spread_px2{0, 0};  // variance along x and y beyond that of the line
};

// The kernel of a motion in the image; empty below kMinMotion_px or where it is not finite.
[[nodiscard]] MotionKernel motion_kernel(const glm::dvec2& motion_px);

// Blurs colour and opacity (premultiplied) by the kernel; energy is kept. Coverage, the truth, stays sharp. The
// rectangle grows by the kernel's margin, within bounds. An empty kernel returns the layer, with its samples shared.
[[nodiscard]] Layer motion_blurred(const Layer& layer, const MotionKernel& kernel, const cv::Rect& bounds);

}  // namespace sigs
