// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "ego_motion/bundle.h"

namespace sigs {

// Ground stands still and clouds do not; the parallax of landmarks shows which is which. Over even ground the inverse
// depth of a landmark rises in proportion to the sine of its angle below the horizon: inverse_depth = g . direction,
// where g points down and has the length 1 / height. No attitude has to be known for it.

// g by least squares over landmarks that agree with the camera's motion and are near enough for parallax, with weights
// of Geman and McClure against hills and houses. None where fewer than 15 are so, or they do not lie below a horizon.
[[nodiscard]] std::optional<Eigen::Vector3d> ground_of(std::span<const Landmark> landmarks);

// 1 below the horizon of `ground` and up to 3 degrees above it (hills), falling to kSkyTrust at 6 degrees. 1 where the
// ground is not known.
[[nodiscard]] double trust_of(const std::optional<Eigen::Vector3d>& ground, const Eigen::Vector3d& direction);

}  // namespace sigs
