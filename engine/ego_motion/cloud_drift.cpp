// SPDX-License-Identifier: MIT
#include "ego_motion/cloud_drift.h"

#include <algorithm>

#include "ego_motion/turns.h"

namespace sigs {

std::vector<double> drift_deviations(std::span<const FrameRotation> rotations, std::span<const double> times_s) {
  constexpr double kClouds_radps = 0.01;
  const auto may_drift = [&](std::size_t k) { return rotations[k].is_linked && !rotations[k].has_ground; };
  std::vector<double> deviations(rotations.size(), 0);
  for (std::size_t k = 1; k < rotations.size();) {
    if (!may_drift(k)) {
      deviations[k] = deviations[k - 1];
      ++k;
      continue;
    }
    const std::size_t before = k - 1;
    while (k < rotations.size() && may_drift(k)) ++k;
    const std::size_t last = k - 1;
    const double seen_rad =
        vector_of(rotations[before].start_from_camera.conjugate() * rotations[last].start_from_camera).norm();
    const double length_s = times_s[last] - times_s[before];
    const double rate_radps = std::min(kClouds_radps, length_s > 0 ? seen_rad / length_s : kClouds_radps);
    for (std::size_t i = before + 1; i <= last; ++i)
      deviations[i] = deviations[before] + rate_radps * (times_s[i] - times_s[before]);
  }
  return deviations;
}

}  // namespace sigs
