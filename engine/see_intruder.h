// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "annotation/measure.h"
#include "compositor/bend.h"
#include "frame.h"
#include "scene/scene_at.h"
#include "video/frame.h"

namespace sigs {

// One intruder as the camera sees it, before it is laid on the picture.
struct SeenIntruder {
  PlacedIntruder placed;
  std::optional<Silhouette> silhouette;
  double sigma_px = 0;
  std::vector<DrawnView> views;  // empty: no part of it can reach the picture, nothing was drawn
  Layer sharp;    // through the lens, over all pixels it can reach within the picture; grown by the blur where that is
                  // made from it
  Layer blurred;  // the same, blurred, clipped to the picture; empty where too faint to change any sample
  Layer soft;     // the same, hidden by the own body; shares its samples where there is none
  double draw_s = 0;         // what OpenGL took
  Work work;                 // that this intruder took up to here
  double whole_area_px = 0;  // of the silhouette, also where it lies outside the picture
};

// The camera that the method has: the footage's, or for `plain`, which knows no lens, the pinhole with its matrix.
[[nodiscard]] Camera seeing_camera(const Scene& scene);

// footage: what the samples mean that it will be laid on; tells from when on it is too faint to change any
[[nodiscard]] Result<SeenIntruder> see_intruder(const Scene& scene, const SceneMoment& moment,
                                                const PlacedIntruder& placed, Bench& bench,
                                                const ColorInfo& footage = {});

// The truth of every intruder, given far to near: nearer ones hide farther ones.
//   mask  ComposedFrame::mask; what was not laid on the picture is not visible in it (the classic method cannot show
//   what
//         lies beyond the edge of its undistorted picture)
[[nodiscard]] std::vector<IntruderTruth> measured(const Scene& scene, const SceneMoment& moment,
                                                  const std::vector<SeenIntruder>& far_to_near, const cv::Mat& mask);

}  // namespace sigs
