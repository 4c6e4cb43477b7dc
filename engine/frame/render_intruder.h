// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "compositor/warp.h"
#include "frame/compose_frame.h"
#include "scene/scene_at.h"
#include "truth/measure.h"
#include "video/frame.h"

namespace sigs {

// One intruder as the camera images it, before it is composited.
struct IntruderLayers {
  PlacedIntruder placed;
  std::optional<Silhouette> silhouette;
  double sigma_px = 0;
  std::vector<RenderedView> views;  // empty: no part of it can reach the image, nothing was drawn
  Layer warped;              // through the lens, over all pixels from which it can reach the image, blur counted in
  Layer blurred;             // the same, blurred, clipped to the image; empty where too faint to change any sample
  Layer occluded;            // the same, hidden by the own body; shares its samples where there is none
  double draw_s = 0;         // what OpenGL took
  OpCounts op_counts;        // that this intruder took up to here
  double whole_area_px = 0;  // of the silhouette, also where it lies outside the image
};

// The camera that the method has: the footage's, or for `plain`, which knows no lens, the pinhole with its matrix.
[[nodiscard]] Camera compositing_camera(const Scene& scene);

// footage: what the samples mean that it will be composited onto; tells from when on it is too faint to change any
[[nodiscard]] Result<IntruderLayers> render_intruder(const Scene& scene, const SceneMoment& moment,
                                                     const PlacedIntruder& placed, ComposeContext& context,
                                                     const ColorInfo& footage = {});

// The truth of every intruder, given far to near: nearer ones hide farther ones.
//   mask  ComposedFrame::mask; what was not composited is not visible in it (the classic method cannot show
//   what
//         lies beyond the edge of its undistorted image)
[[nodiscard]] std::vector<IntruderTruth> measured(const Scene& scene, const SceneMoment& moment,
                                                  const std::vector<IntruderLayers>& far_to_near, const cv::Mat& mask);

}  // namespace sigs
