// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "camera/lens.h"
#include "scene/scene.h"
#include "scene/scene_at.h"

namespace sigs {

// How far an intruder's reference point moves in the image while the shutter is open, px: from the first half of the
// exposure to the second, by the camera's turn and by both flights. A rolling shutter opens later for each row; the
// point is projected as it is when the rows open in which it appears. (0, 0) where it has no image at either end.
[[nodiscard]] glm::dvec2 motion_during_exposure(const Scene& scene, const SceneMoment& moment,
                                                const PlacedIntruder& placed, const Lens& lens);

// Where the reference point was in the frames before this one against where it is in this one, px: one frame earlier,
// two frames earlier, ... Ends before the footage's first frame, and where the point has no image. Positions are those
// of a global shutter.
//   count  frames before this one at most
[[nodiscard]] std::vector<cv::Point2d> earlier_places(const Scene& scene, int frame, const PlacedIntruder& placed,
                                                      const Lens& lens, int count);

}  // namespace sigs
