// SPDX-License-Identifier: MIT
#include "world_lock/image_motion.h"

#include <algorithm>
#include <cmath>

#include "world_lock/background_point.h"

namespace sigs::bench {

ImageMotion image_motion(const Clip& clip) {
  constexpr std::size_t kEnough = 12;
  cv::Point2d sum, least, most;
  double square = 0;
  int frames = 0;
  Pyramid before = pyramid_of(clip.luma[0]);
  for (int n = 1; n < clip.frame_count(); ++n) {
    Pyramid after = pyramid_of(clip.luma[static_cast<std::size_t>(n)]);
    const Displacements found = displacements(clip.luma[static_cast<std::size_t>(n) - 1], before, after,
                                              clip.world_mask(n - 1), {.corners = 150, .spacing_px = 20});
    before = std::move(after);
    if (found.moves.size() < kEnough) continue;
    const Displacement step = middle_of(found);
    ++frames;
    square += step.px.dot(step.px);
    sum += step.px;
    least = {std::min(least.x, sum.x), std::min(least.y, sum.y)};
    most = {std::max(most.x, sum.x), std::max(most.y, sum.y)};
  }
  return {.step_rms_px = frames > 0 ? std::sqrt(square / frames) : 0,
          .range_px = std::max(most.x - least.x, most.y - least.y),
          .tracked = static_cast<double>(frames) / std::max(1, clip.frame_count() - 1)};
}

}  // namespace sigs::bench
