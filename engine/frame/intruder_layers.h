// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "base/image.h"
#include "camera/row_motion.h"
#include "compositor/blur.h"
#include "compositor/warp.h"
#include "frame/composed_frame.h"
#include "scene/scene_at.h"
#include "truth/measure.h"

namespace sigs {

// One intruder of one frame on its way from the mesh to the image. Each member is filled by one stage, in this order.
struct IntruderLayers {
  PlacedIntruder placed;
  Pose<frame::World, frame::Camera> world_from_camera;
  std::optional<RowMotion> row_motion;   // of a rolling shutter; none where all rows are read at once
  std::optional<Silhouette> silhouette;  // of the model's points through the lens
  double sigma_px = 0;                   // of the blur: the lens' own, and that at this distance
  MotionKernel motion;                   // in the image, during the exposure; empty: none
  double motion_px = 0;                  // its length; 0: none
  std::vector<RenderedView> views;       // empty where no part of it can be in the image
  Layer warped;                          // through the lens, with the margin beyond the image that the blurs need
  Layer hazed;                           // in the footage's tones, behind haze; shares its samples where both are off
  Layer motion_blurred;                  // blurred by its motion; likewise
  Layer blurred;                         // clipped to the image; empty where too faint to change any sample
  Layer occluded;            // without what own body and occluder hide; shares its samples where they hide nothing
  double whole_area_px = 0;  // of the silhouette, the part outside the image included
  double draw_s = 0;         // seconds of OpenGL
  OpCounts op_counts;
};

}  // namespace sigs
