// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace sigs {

// A feature seen in one frame.
struct RayObservation {
  int id = 0;           // the same for the same feature in all frames
  Eigen::Vector3d ray;  // unit, in camera axes
  double row = 0;       // where it is in the image: -0.5 at the first row, 0 in the middle, 0.5 at the last
};

// All features seen in one frame, by rising id.
using FrameRays = std::vector<RayObservation>;

// One feature seen in two frames.
struct RayPair {
  Eigen::Vector3d before;
  Eigen::Vector3d after;
};

// The features that both frames have.
[[nodiscard]] inline std::vector<RayPair> common_rays(const FrameRays& before, const FrameRays& after) {
  std::vector<RayPair> pairs;
  auto b = after.begin();
  for (const RayObservation& a : before) {
    while (b != after.end() && b->id < a.id) ++b;
    if (b == after.end()) break;
    if (b->id == a.id) pairs.push_back({a.ray, b->ray});
  }
  return pairs;
}

}  // namespace sigs
