// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/image.h"
#include "camera/lens.h"
#include "scene/scene.h"
#include "scene/scene_at.h"

namespace sigs {

// The shadow of an intruder on level ground, the world's plane z = 0 (docs/shadows.md).

// A point's shadow: where the line from the sun through it meets the ground.
//   to_sun  unit vector; the sun stands above the horizon (z < 0)
// None: the point lies on the ground or below it, or the sun does not.
[[nodiscard]] std::optional<glm::dvec3> shadow_of(const glm::dvec3& point_m, const glm::dvec3& to_sun);

// A shadow as it is seen: black, with the opacity that it takes of the ground's light; no coverage, as it is no part of
// the target. Softened by the sun's disc: a Gaussian of the standard deviation of a disc that is as wide as the
// penumbra, in both directions that of the image's mean scale there. Empty: none is seen within bounds, the scene draws
// none, or its sun stands below the horizon or its camera below the ground. In a 360 degree image bounds are those of
// the window around the shadow (frame/panorama.h), whatever columns are asked for; of one around the nadir that a
// triangle of the mesh covers, the rows next to it stay bright.
struct GroundShadow {
  Layer layer;
  double distance_m = 0;  // from the camera to the shadow of the intruder's reference point
};
[[nodiscard]] GroundShadow ground_shadow(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                         const Lens& lens, double sigma_px, const cv::Rect& bounds);

}  // namespace sigs
