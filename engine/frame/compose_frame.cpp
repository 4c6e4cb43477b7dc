// SPDX-License-Identifier: MIT
#include "frame/compose_frame.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "compositor/blur.h"
#include "compositor/occlude.h"
#include "compositor/warp.h"
#include "frame/composite.h"
#include "frame/occluder.h"
#include "frame/render_plan.h"
#include "frame/standing_out.h"
#include "scene/scene_at.h"
#include "truth/measure.h"

namespace sigs {

namespace {

// The classic method blurs whole images of its own. Of a single intruder's layer it needs the coverage alone, which
// blur does not change; with several, the blurred opacity determines what a nearer one occludes of a farther one.
bool needs_blurred_layers(const Scene& scene) {
  return scene.compositing.method != MethodChoice::classic || scene.intruders.size() > 1;
}

// Unit vector away from the ground.
glm::dvec3 up_in_camera(const SceneMoment& moment) {
  return glm::conjugate(moment.world_from_camera.rotation) * glm::dvec3(0, 0, -1);
}

// What measuring needs of the intruders.
std::vector<MeasuredLayers> measured_layers(const Scene& scene, const std::vector<IntruderLayers>& far_to_near) {
  std::vector<MeasuredLayers> all;
  for (const IntruderLayers& layers : far_to_near) {
    const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(layers.placed.id)];
    all.push_back({.id = layers.placed.id,
                   .name = intruder.name,
                   .camera_from_body = layers.placed.camera_from_body,
                   .attitude = layers.placed.attitude,
                   .silhouette = layers.silhouette,
                   .outermost_m = intruder.model->outermost_m,
                   .whole_area_px = layers.whole_area_px,
                   .inside = clipped(layers.warped, {{0, 0}, scene.footage.size_px}),
                   .max_coverage = max_coverage(layers.warped.coverage),
                   .occluded = layers.occluded});
  }
  return all;
}

CameraTruth camera_truth(const Scene& scene, const SceneMoment& moment) {
  return {.position_source = scene.motion.source.position,
          .attitude_source = scene.motion.source.attitude,
          .attitude_sd_rad = attitude_sd_at(scene.motion.deviations, moment.time_s)};
}

FrameTruth truth_of(const Scene& scene, const SceneMoment& moment, int frame, const ComposedFrame& composed,
                    const std::vector<IntruderLayers>& far_to_near) {
  return {.index = frame,
          .time_s = moment.time_s,
          .substituted = composed.image.damaged,
          .camera_position_m = moment.world_from_camera.translation_m,
          .camera_attitude = attitude_of(moment.world_from_camera.rotation),
          .camera = camera_truth(scene, moment),
          .intruders = measured(measured_layers(scene, far_to_near), composed.mask,
                                scene.horizon_is_known ? std::optional(up_in_camera(moment)) : std::nullopt)};
}

// How the image of each intruder was formed.
void add_image_formation(const std::vector<IntruderLayers>& far_to_near, FrameTruth& truth) {
  for (const IntruderLayers& layers : far_to_near)
    for (IntruderTruth& intruder : truth.intruders)
      if (intruder.id == layers.placed.id) intruder.image_formation.blur_px = layers.sigma_px;
}

// Places of the camera and of the intruders on the Earth.
void add_places(const Scene& scene, const SceneMoment& moment, FrameTruth& truth) {
  if (!scene.earth) return;
  truth.camera.place = scene.earth->place_of(moment.world_from_camera.translation_m);
  for (IntruderTruth& intruder : truth.intruders)
    intruder.place = scene.earth->place_of(moment.world_from_camera * intruder.position_m);
}

}  // namespace

Result<IntruderLayers> intruder_layers(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                       ComposeContext& context, const ColorInfo& footage) {
  LensTable& lens = context.lens_of(compositing_camera(scene));
  const std::int64_t evaluations_before = lens.evaluations();
  IntruderLayers layers = placed_layers(scene, moment, placed, lens.camera());
  const RenderPlan plan = render_plan_for(layers, lens, scene, moment);
  if (!plan.views.empty()) {
    const Result<Renderer*> renderer = context.renderer();
    if (!renderer) return fail(renderer.error());
    Result<std::vector<RenderedView>> views = rendered_views(plan.views, plan, scene, layers, **renderer);
    if (!views) return fail(views.error());
    layers.views = std::move(*views);
    layers.warped = warped(layers.views, lens, plan.warp_rect, turn_of_row(layers));
    const cv::Rect image({0, 0}, scene.footage.size_px);
    if (is_visible_after_blur(layers.warped, layers.sigma_px, footage))
      layers.blurred = needs_blurred_layers(scene) ? blurred_within(layers.warped, layers.sigma_px, image)
                                                   : clipped(layers.warped, image);
    layers.occluded = occluded_by_body(layers.blurred, scene.own_body);
    if (scene.occluder.hides(placed.distance_m()) && !layers.occluded.empty())
      layers.occluded = occluded_by(
          layers.occluded, occluder_seen_from(moment.world_from_camera, scene.occluder, lens, layers.occluded.rect));
    const Result<double> area = whole_area_px(layers, plan, lens, scene, **renderer);
    if (!area) return fail(area.error());
    layers.whole_area_px = *area;
    layers.op_counts.pixels_warped += layers.warped.rect.area();
    if (layers.sigma_px > 0 && needs_blurred_layers(scene))
      layers.op_counts.pixels_blurred += layers.blurred.rect.area();
  }
  layers.op_counts.lens_evaluations += lens.evaluations() - evaluations_before;
  return layers;
}

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, Frame&& background, ComposeContext& context,
                                    Stages stages) {
  ENSURE(background.size_px() == scene.footage.size_px);
  const Stopwatch watch;
  const SceneMoment moment = scene_at(scene, frame);
  std::vector<IntruderLayers> far_to_near;
  for (const PlacedIntruder& placed : moment.intruders) {
    Result<IntruderLayers> layers = intruder_layers(scene, moment, placed, context, background.color);
    if (!layers) return fail(layers.error());
    far_to_near.push_back(std::move(*layers));
  }
  const std::vector<FootageLuma> footage_luma = footage_luma_of(background, far_to_near);
  ComposedFrame composed = composited(std::move(background), scene, far_to_near, context, stages);
  composed.truth = truth_of(scene, moment, frame, composed, far_to_near);
  add_detectability(composed.truth.intruders, composed.image, footage_luma, scene);
  add_image_formation(far_to_near, composed.truth);
  add_places(scene, moment, composed.truth);
  for (const IntruderLayers& layers : far_to_near) {
    composed.op_counts += layers.op_counts;
    composed.times.draw_s += layers.draw_s;
  }
  composed.times.composite_s = watch.elapsed_s() - composed.times.draw_s;
  return composed;
}

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, const Frame& background, ComposeContext& context,
                                    Stages stages) {
  return compose_frame(scene, frame, cloned(background), context, stages);
}

}  // namespace sigs
