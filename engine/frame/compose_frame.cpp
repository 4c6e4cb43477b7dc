// SPDX-License-Identifier: MIT
#include "frame/compose_frame.h"

#include <algorithm>
#include <utility>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "frame/composite.h"
#include "frame/render_intruder.h"

namespace sigs {

namespace {

bool is_same(const Camera& a, const Camera& b) {
  return a.size_px == b.size_px && a.lens.parameters() == b.lens.parameters();
}

FrameTruth truth_of(const SceneMoment& moment, int frame, std::vector<IntruderTruth> intruders) {
  std::sort(intruders.begin(), intruders.end(),
            [](const IntruderTruth& a, const IntruderTruth& b) { return a.id < b.id; });
  return {.index = frame,
          .time_s = moment.time_s,
          .camera_position_m = moment.world_from_camera.translation_m,
          .camera_attitude = attitude_of(moment.world_from_camera.rotation),
          .intruders = std::move(intruders)};
}

}  // namespace

Result<Renderer*> ComposeContext::renderer() {
  if (!renderer_) {
    Result<Renderer> made = Renderer::create(settings_.samples_per_pixel);
    if (!made) return fail(made.error());
    renderer_.emplace(std::move(*made));
  }
  return &*renderer_;
}

const DistortMaps& ComposeContext::maps_of(const Camera& camera) {
  if (!camera_of_maps_ || !is_same(*camera_of_maps_, camera)) {
    maps_ = distort_maps(camera);
    camera_of_maps_ = camera;
  }
  return *maps_;
}

LensTable& ComposeContext::lens_of(const Camera& camera) {
  if (!lens_ || !is_same(lens_->camera(), camera)) lens_.emplace(camera, settings_.lens_tolerance_px);
  return *lens_;
}

void ComposeContext::forget(const Mesh& mesh) {
  if (renderer_) renderer_->forget(mesh);
}

std::string ComposeContext::renderer_description() const {
  return renderer_ ? renderer_->description() : std::string();
}

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, Frame&& background, ComposeContext& context,
                                    Stages stages) {
  ENSURE(background.size_px() == scene.footage.size_px);
  const SceneMoment moment = scene_at(scene, frame);

  const Stopwatch watch;
  std::vector<IntruderLayers> layers;
  double draw_s = 0;
  for (const PlacedIntruder& placed : moment.intruders) {
    Result<IntruderLayers> intruder = render_intruder(scene, moment, placed, context, background.color);
    if (!intruder) return fail(intruder.error());
    draw_s += intruder->draw_s;
    layers.push_back(std::move(*intruder));
  }
  ComposedFrame composed = composited(std::move(background), scene, layers, context, stages);
  for (const IntruderLayers& intruder : layers) composed.op_counts += intruder.op_counts;
  composed.truth = truth_of(moment, frame, measured(scene, moment, layers, composed.mask));
  composed.truth.substituted = composed.image.damaged;
  composed.times = {draw_s, watch.elapsed_s() - draw_s};
  return composed;
}

Result<ComposedFrame> compose_frame(const Scene& scene, int frame, const Frame& background, ComposeContext& context,
                                    Stages stages) {
  return compose_frame(scene, frame, cloned(background), context, stages);
}

}  // namespace sigs
