// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sigs {

// A feature seen in one frame.
struct RayObservation {
  int id = 0;      // the same for the same feature in all frames
  glm::dvec3 ray;  // unit, in camera axes
  double row = 0;  // where it is in the image: -0.5 at the first row, 0 in the middle, 0.5 at the last
};

// All features seen in one frame, by rising id.
using FrameRays = std::vector<RayObservation>;

// How the camera turns while a frame's rows are exposed, about its own axes: t after the middle row it has turned by
// rate t + rate_change t^2 / 2 since then.
struct ReadoutTurn {
  glm::dvec3 rate_radps = glm::dvec3(0);
  glm::dvec3 rate_change_radps2 = glm::dvec3(0);

  [[nodiscard]] glm::dvec3 after(double time_s) const {
    return rate_radps * time_s + rate_change_radps2 * (time_s * time_s / 2);
  }
  ReadoutTurn& operator+=(const ReadoutTurn& more) {
    rate_radps += more.rate_radps;
    rate_change_radps2 += more.rate_change_radps2;
    return *this;
  }
};

// One feature seen in two frames.
struct RayPair {
  glm::dvec3 before;
  glm::dvec3 after;
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
