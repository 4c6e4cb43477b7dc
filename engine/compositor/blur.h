// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "base/image.h"
#include "camera/lens.h"
#include "video/frame.h"

namespace sigs {

// Pixels over which a Gaussian carries a pixel: ceil(3 sigma_px).
[[nodiscard]] int blur_margin_px(double sigma_px);

// One axis of a Gaussian on whole pixels: 2 margin + 1 samples (CV_32FC1, a column) that sum to one, with the variance
// sigma_px^2 also far below a pixel. Samples too small to change an 8-bit value are 0: a blur of negligible width
// changes no neighbour. sigma_px == 0 gives 1 in the middle.
//   margin  samples on each side; with blur_margin_px(sigma_px) the cut takes up to 2.7 % of the variance
[[nodiscard]] cv::Mat sampled_gaussian(double sigma_px, int margin);

// Blurs as the lens does at distance. Works on premultiplied colour, so the sky never bleeds in. The rectangle grows by
// blur_margin_px(sigma_px) on every side; coverage, the truth, is not blurred. sigma_px == 0 returns the layer
// unchanged. The kernel is a Gaussian on whole pixels with the variance sigma_px^2, also far below a pixel; cut at
// three sigmas, which takes up to 2.7 % of the variance, and of sum one: energy is kept. What it leaves at an edge is
// at most 8 % of the step (at sigma 0.4; 2 % from 1 on, half a percent from 2 on) away from the light blurred before
// pixels average it.
[[nodiscard]] Layer blurred(const Layer& layer, double sigma_px);

// The same with a sigma of its own along each axis.
[[nodiscard]] Layer blurred(const Layer& layer, const glm::dvec2& sigma_px);

// Above this sigma a blur is computed at positions a quarter of sigma apart, and the cost no longer grows with sigma.
inline constexpr double kWideSigma_px = 16;

// The same blur for any sigma above kWideSigma_px, 1e30 px too, over target's pixels alone. It differs from blurred()
// by at most 1.2 % of the highest value, where the kernel's cut (a step of exp(-4.5)) comes out soft, and by less than
// 0.5 % in the root of the mean square.
[[nodiscard]] Layer widely_blurred(const Layer& layer, double sigma_px, const cv::Rect& target);

// The blur of any sigma, over the pixels of `image` alone: blurred() or, above kWideSigma_px, widely_blurred().
//   spread_px2  variance along each axis that the layer has been spread by already; the blur has so much less of it
[[nodiscard]] Layer blurred_within(const Layer& layer, double sigma_px, const cv::Rect& image,
                                   const glm::dvec2& spread_px2 = {0, 0});

// The same through a lens. Of one whose columns repeat (Lens::period_px), where the blur is that of an angle: sigma_px
// is that of the middle rows, and across it is wider towards the poles, as columns become narrower, by 1 /
// cos(elevation).
//   image  the pixels wanted; of such a lens all rows, and as many columns as the image has, wherever they begin. A
//   layer
//          at least as wide is all around; else nothing of it lies beyond the columns wanted
[[nodiscard]] Layer blurred_through(const Lens& lens, const Layer& layer, double sigma_px, const cv::Rect& image,
                                    const glm::dvec2& spread_px2 = {0, 0});

// How much wider across a blur is in a row of such a lens than in the middle ones, at least 1: 1 / cos(elevation),
// within half a pixel of a pole as there. 1 of any other lens.
[[nodiscard]] double widening_at(const Lens& lens, double row);

// Upper bound of any channel of any pixel after a blur above kWideSigma_px.
[[nodiscard]] double max_after_blur(const Layer& layer, double sigma_px);

// False where a wide blur leaves the layer too faint to change any sample of a footage with these colours and this
// depth.
[[nodiscard]] bool is_visible_after_blur(const Layer& layer, double sigma_px, const ColorInfo& footage,
                                         int bit_depth = 8);

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
