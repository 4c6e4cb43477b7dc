// SPDX-License-Identifier: MIT
#include "reference/gaussian_weights.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace sigs::truth {
namespace {

// Simpson's rule with 2000 steps.
double integrated(double x_px, double sigma_px, double from, double to) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double z = (from + (to - from) * i / kSteps - x_px) / sigma_px;
    sum += std::exp(-z * z / 2) * (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2);
  }
  return sum * (to - from) / kSteps / 3 / (sigma_px * std::sqrt(2 * std::numbers::pi));
}

}  // namespace

TEST_CASE("a point's blur over pixels is the Gaussian's integral over each") {
  for (const double sigma_px : {0.1, 0.3, 0.5, 1.0, 2.0, 7.0})
    for (const double x_px : {0.0, 0.49, 17.2, -3.8}) {
      const GaussianWeights spread = to_pixels(x_px, sigma_px);
      CHECK(std::accumulate(spread.weights.begin(), spread.weights.end(), 0.0) == doctest::Approx(1).epsilon(1e-14));
      for (std::size_t i = 0; i < spread.weights.size(); ++i) {
        const double pixel = spread.first_target + double(i);
        // The part beyond six sigmas is added to the last pixels.
        CHECK(std::abs(spread.weights[i] - integrated(x_px, sigma_px, pixel - 0.5, pixel + 0.5)) < 3e-9);
      }
    }
}

TEST_CASE("without blur a point is all in its own pixel") {
  for (const double sigma_px : {0.0, 1e-6}) {
    const GaussianWeights spread = to_pixels(-2.4, sigma_px);
    for (std::size_t i = 0; i < spread.weights.size(); ++i)
      CHECK(spread.weights[i] == (spread.first_target + static_cast<int>(i) == -2 ? 1.0 : 0.0));
  }
}

TEST_CASE("two Gaussians with nodes between them give the Gaussian of their combined variance") {
  const double part_px = 3 / std::numbers::sqrt2;
  for (const double x_px : {0.0, 0.3, -41.77}) {
    const GaussianWeights direct = to_pixels(x_px, 3);
    const double step_px = kStepsOfNodes * part_px;
    const GaussianWeights nodes = to_nodes(x_px, part_px, step_px);
    for (std::size_t i = 0; i < direct.weights.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < nodes.weights.size(); ++k) {
        const GaussianWeights second = to_pixels((nodes.first_target + double(k)) * step_px, part_px);
        const int at = direct.first_target + static_cast<int>(i) - second.first_target;
        if (at >= 0 && at < static_cast<int>(second.weights.size()))
          sum += nodes.weights[k] * step_px * second.weights[static_cast<std::size_t>(at)];
      }
      CHECK(std::abs(sum - direct.weights[i]) < 1e-8);
    }
  }
}

}  // namespace sigs::truth
