// SPDX-License-Identifier: MIT
#pragma once

#include "reference/ray_tracer.h"
#include "reference/reference.h"

namespace sigs::truth {

// Traces the grid's rays and accumulates their light: each ray is a point of light that the Gaussian spreads, exactly,
// over the pixels. Up to kDirect_px of sigma that is done at once; above, in two Gaussians of sigma / sqrt(2) with a
// grid of nodes between them, which is the same within 1e-8 of the whole and costs no more as sigma grows. The same
// bytes on every number of threads.
[[nodiscard]] ReferenceImage accumulated(const RayTracer& tracer, const FineGrid& grid, double sigma_px,
                                         const cv::Rect& image);

inline constexpr double kDirect_px = 2;

}  // namespace sigs::truth
