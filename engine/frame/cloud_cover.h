// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "frame/render_plan.h"
#include "horizon/cloud_map.h"
#include "scene/scene.h"
#include "video/frame.h"

namespace sigs {

// Share of what an intruder shows that the clouds before it let through: (1 - opacity)^depth, and within clouds, where
// depth is below 1, as if they let through 0.01 at least.
//   opacity  of the clouds as they are seen, 0..1
//   depth    of the clouds before the intruder, as a share of all: by Scene::clouds and its distance, 0..1
[[nodiscard]] double cloud_transmission(double opacity, double depth);

// The clouds of a frame, before anything is blended onto it; none where nothing asks for them: the project's clouds
// hide nothing, or all that is in the image is nearer and no stages are kept.
[[nodiscard]] std::optional<CloudMap> clouds_of(const Scene& scene, const Frame& background,
                                                const std::vector<IntruderLayers>& all, Stages stages);

// Takes from the layers, contrails and lights what the clouds hide of them, and fills `clouds`. The veil of a thin
// cloud stays before the intruder as bright as it is before the sky. Thermal footage: contrast alone falls.
//   map  clouds_of() the frame
void hide_behind_clouds(const Scene& scene, const CloudMap* map, std::vector<IntruderLayers>& all);

}  // namespace sigs
