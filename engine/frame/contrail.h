// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "base/image.h"
#include "camera/lens.h"
#include "scene/scene.h"
#include "scene/scene_at.h"

namespace sigs {

// The trail of ice behind a jet: strands with a Gaussian profile that widens with age (docs/contrails.md).

// A place of a strand's middle, as the camera sees it.
struct TrailPoint {
  glm::dvec2 pixel{0, 0};
  double sigma_px = 0;  // of the profile across the strand
  double depth = 0;     // optical depth of the middle, along the line of sight
  double distance_m = 0;
};

// Places along a strand, from its beginning behind the engine on.
using TrailStrand = std::vector<TrailPoint>;

// The strands of an intruder's contrail, as far as the lens has an image of them; a strand that leaves the lens's field
// and comes back is two. Empty: it has none, or flies below 1 m/s.
[[nodiscard]] std::vector<TrailStrand> contrail_strands(const Scene& scene, const SceneMoment& moment,
                                                        const PlacedIntruder& placed, const Lens& lens);

// Strands as the camera would see them without haze.
struct Trail {
  Layer layer;
  cv::Mat distance_m;  // CV_32FC1 over the layer: of the ice in a pixel, in the mean; 0 where there is none
};

// The strands over their pixels within bounds: opacity 1 - exp(-sum of depths), of one colour (linear
// light). A profile narrower than a pixel is spread over one. No coverage: a trail is no part of the silhouette.
[[nodiscard]] Trail trail_of(std::span<const TrailStrand> strands, const cv::Vec3d& color, const cv::Rect& bounds);

// What the trail's ice looks like in the scene's light, where nothing shines through: linear light.
[[nodiscard]] cv::Vec3d contrail_color(const Scene& scene, const SceneMoment& moment, const ContrailSettings& contrail);

// Whether the trail lies between the camera and its aircraft, which then flies away.
[[nodiscard]] bool is_before_aircraft(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed);

}  // namespace sigs
