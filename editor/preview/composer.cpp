// SPDX-License-Identifier: MIT
#include "editor/preview/composer.h"

#include <algorithm>
#include <utility>

#include "base/guarded.h"
#include "editor/preview/turntable.h"
#include "scene/scene_parts.h"
#include "scene/stand_ins.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kModelsKept = 8;  // beside those of the scene
constexpr double kCrossLength_m = 10;

// The untouched footage where composing fails for want of OpenGL or memory.
Result<ComposedFrame> composed(const Scene& scene, int frame, const Frame& background, Bench& bench, Stages stages) {
  return guarded([&] { return compose_frame(scene, frame, background, bench, stages); }, "composing");
}

// Shares everything large with the scene it is made from.
Scene with_method(const Scene& scene, MethodChoice method) {
  Scene other = scene;
  other.compositing.method = method;
  return other;
}

}  // namespace

void Composer::keep(const std::shared_ptr<const Model>& model) {
  std::erase(drawn_, model);
  drawn_.push_back(model);
}

void Composer::drop_unused(std::size_t in_use) {
  while (drawn_.size() > in_use + kModelsKept) {
    bench_.forget(drawn_.front()->mesh);
    drawn_.pop_front();
  }
}

std::shared_ptr<const OpenedScene> Composer::opened(const Revision& revision, std::shared_ptr<const Footage> footage) {
  DraftScene draft = draft_scene(*revision.project, footage->shape, files_);
  for (const std::shared_ptr<const Model>& model : draft.scene.models) keep(model);
  drop_unused(draft.scene.models.size());
  return std::make_shared<const OpenedScene>(OpenedScene{.revision = revision.number,
                                                         .project = revision.project,
                                                         .footage = std::move(footage),
                                                         .draft = std::move(draft)});
}

std::shared_ptr<const Picture> Composer::picture(const OpenedScene& opened, int frame, const Decoded& footage,
                                                 Stages stages, std::optional<MethodChoice> method) {
  const Scene& own = opened.draft.scene;
  auto picture = std::make_shared<Picture>(
      Picture{.revision = opened.revision, .frame = frame, .method = method, .problem = footage.problem});
  Result<ComposedFrame> made = method ? composed(with_method(own, *method), frame, footage.frame, bench_, stages)
                                      : composed(own, frame, footage.frame, bench_, stages);
  if (!made) {
    picture->bgr = bgr_of(footage.frame);
    picture->truth = {.index = frame, .time_s = time_of_frame_s(own.footage, frame)};
    picture->problem = made.error().text();
    return picture;
  }
  picture->bgr = bgr_of(made->picture);
  picture->mask = made->mask;
  picture->truth = std::move(made->truth);
  picture->stages = std::move(made->stages);
  picture->times = made->times;
  return picture;
}

std::shared_ptr<const ModelPicture> Composer::model_picture(const Project& project, const Wanted::Turntable& wanted) {
  const Project sound = mended(project);
  const auto intruder = static_cast<std::size_t>(wanted.intruder);
  const ModelSettings& settings = sound.intruders[intruder].model;
  auto picture = std::make_shared<ModelPicture>(
      ModelPicture{.file = resolved(project, settings.file), .turn_rad = wanted.turn_rad});
  const Made<std::shared_ptr<const Model>> made = made_model(sound, intruder, files_);
  if (!made) picture->problem = made.error().what;
  const std::shared_ptr<const Model> model =
      made ? *made : files_.cross(settings.length_m > 0 ? settings.length_m : kCrossLength_m);
  keep(model);
  picture->size_m = glm::dvec3(model->mesh.high_m) - glm::dvec3(model->mesh.low_m);
  const Result<Renderer*> renderer = bench_.renderer();
  const Result<cv::Mat> rgba = renderer ? turntable_picture(model->mesh, wanted.turn_rad, wanted.size_px, **renderer)
                                        : Result<cv::Mat>(fail(renderer.error()));
  if (rgba)
    picture->rgba = *rgba;
  else
    picture->problem = rgba.error().text();
  return picture;
}

}  // namespace sigs::editor
