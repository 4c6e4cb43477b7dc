// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "camera/lens.h"
#include "camera/lens_table.h"
#include "camera/row_motion.h"
#include "camera/virtual_camera.h"
#include "compositor/blur.h"
#include "compositor/warp.h"
#include "frame/aircraft_lights.h"
#include "frame/composed_frame.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "scene/scene_at.h"
#include "truth/measure.h"

namespace sigs {

// Where something that moves is seen, and how long after the frame's time the row opens in which it is.
struct SeenInRow {
  glm::dvec2 pixel{0, 0};
  double row_s = 0;
};

//   pixel_at  where it has its image so long after the frame's time; none: nowhere
// None: it has no image. With a global shutter it is asked for once, at 0.
[[nodiscard]] std::optional<SeenInRow> seen_in_row(
    const Scene& scene, const std::function<std::optional<glm::dvec2>(double row_s)>& pixel_at);

// One intruder of one frame on its way from the mesh to the image. Each member is filled by one stage, in this order.
struct IntruderLayers {
  PlacedIntruder placed;
  Pose<frame::World, frame::Camera> world_from_camera;
  std::optional<RowMotion> row_motion;   // of a rolling shutter; none where all rows are read at once
  std::optional<Silhouette> silhouette;  // of the model's points through the lens
  std::optional<Silhouette> body;      // the same without rotors; only where those do not count and the model has some
  cv::Rect window;                     // the image or, of a 360 degree one, as many columns around the intruder
  ImageFormation formation;            // as labels tell it; blur_px: the lens' own blur, and that at this distance
  MotionKernel motion;                 // in the image, during the exposure; empty: none
  glm::dvec2 motion_xy_px{0, 0};       // the same before it is shortened
  std::vector<RenderedView> views;     // empty where no part of it can be in the image
  std::vector<RenderedView> given_up;  // coarse views that tell too little; their memory serves the next frame's
  Layer warped;                        // through the lens, with the margin beyond the window that the blurs need
  Layer hazed;                         // in the footage's tones, behind haze; shares its samples where both are off
  Layer motion_blurred;                // blurred by its motion; likewise
  Layer blurred;                       // clipped to the window; empty where too faint to change any sample
  Layer occluded;  // without what own body, occluder and clouds hide; shares its samples where they hide nothing
  Layer contrail;  // clipped to the window, without what is hidden; empty: none
  bool contrail_is_nearer = false;     // than the aircraft
  Layer shadow;                        // on the ground, clipped to a window, without what is hidden; empty: none
  std::vector<LampLayer> lamps;        // the aircraft's lights, clipped to a window, without what is hidden
  std::vector<LampTruth> lamp_truths;  // one for each of them
  std::optional<CloudTruth> clouds;    // none: the scene has no clouds that hide anything
  double whole_area_px = 0;            // of the silhouette, the part outside the image included
  double draw_s = 0;                   // seconds of OpenGL
  OpCounts op_counts;
};

// Where an intruder is, before anything is rendered: its silhouette through the lens and the blur at its distance. The
// lens evaluations are counted.
[[nodiscard]] IntruderLayers placed_layers(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                           const Camera& camera);

// The same lens with pixels of step by step of its own: pixel (i, j) covers the square [i, i + 1) x [j, j + 1) times
// step, from the upper left corner of the image.
[[nodiscard]] Lens with_pixels_of(const Lens& lens, double step);

// For warped(): where the rays of a row lead. step: size of its pixels in the image's.
[[nodiscard]] RowTransform row_transform(const IntruderLayers& layers, double step = 1);

// What is to be rendered of an intruder.
struct RenderPlan {
  cv::Rect warp_rect;                 // pixels of the warped layer; may extend beyond the image by the blur's margin
  std::vector<VirtualCamera> views;   // virtual cameras; none where no part of the intruder can be in the image
  std::array<glm::dvec3, 8> corners;  // of the box around the mesh, metres, camera frame
  Light light;                        // camera frame
  double time_s = 0;                  // of the middle row
  double exposure_s = 0;              // 0: not known
};

[[nodiscard]] RenderPlan render_plan_for(const IntruderLayers& layers, LensTable& lens, const Scene& scene,
                                         const SceneMoment& moment);

// One image of the intruder for each virtual camera of the plan. Counts the operations, and adds the seconds to
// layers.draw_s.
[[nodiscard]] Result<std::vector<RenderedView>> rendered_views(const std::vector<VirtualCamera>& views,
                                                               const RenderPlan& plan, const Scene& scene,
                                                               IntruderLayers& layers, Renderer& renderer);

// The same where smooth parts may be drawn coarsely (compositing.quality auto): each view is drawn with a pixel for
// each pixel of the image, and then finely where that does not tell enough. As rendered_views() where that would save
// little.
[[nodiscard]] Result<std::vector<RenderedView>> sparingly_rendered_views(const RenderPlan& plan, const Scene& scene,
                                                                         LensTable& lens, IntruderLayers& layers,
                                                                         Renderer& renderer);

// Area of the whole silhouette in pixels. Where it extends beyond the warped layer, a coarse image of all of it is
// rendered through the same lens and summed.
[[nodiscard]] Result<double> whole_area_px(IntruderLayers& layers, const RenderPlan& plan, const LensTable& lens,
                                           const Scene& scene, Renderer& renderer);

// Where the reference point was in the frames before this one against where it is in this one, px: one frame earlier,
// two frames earlier, ... Ends before the footage's first frame, and where the point has no image. Positions are those
// of a global shutter.
//   count  frames before this one at most
[[nodiscard]] std::vector<cv::Point2d> earlier_places(const Scene& scene, int frame, const PlacedIntruder& placed,
                                                      const Lens& lens, int count);

}  // namespace sigs
