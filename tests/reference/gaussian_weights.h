// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace sigs::truth {

// Along one axis: how much of a sample at a place goes to each of some targets in a row.
struct GaussianWeights {
  int first_target = 0;  // may be negative
  std::vector<double> weights;
};

// Beyond so many sigmas lies 2e-9 of a Gaussian, which is left out.
inline constexpr double kReachOfBlur = 6;

// To pixels: the Gaussian around x_px integrated over each pixel (base/image.h's convention). The exact blur of a
// point, averaged over pixels. sigma_px 0: all to the pixel around it.
[[nodiscard]] GaussianWeights to_pixels(double x_px, double sigma_px);

// To the nodes k * step_px, the Gaussian's density at each. When the nodes' sums go to pixels by another such Gaussian,
// their product is one of sigma / sqrt(2), and sums over nodes approximate its integral, with an error of
// exp(-(pi sigma / step)^2), 1e-12 at kStepsOfNodes (Poisson's sum formula).
[[nodiscard]] GaussianWeights to_nodes(double x_px, double sigma_px, double step_px);
inline constexpr double kStepsOfNodes = 0.6;  // step / sigma

}  // namespace sigs::truth
