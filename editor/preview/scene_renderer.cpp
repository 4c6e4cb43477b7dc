// SPDX-License-Identifier: MIT
#include "editor/preview/scene_renderer.h"

#include <algorithm>
#include <utility>

#include "base/threads.h"
#include "editor/preview/turntable.h"
#include "scene/draft.h"
#include "scene/scene_parts.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kModelsKept = 8;  // beside those of the scene
constexpr double kCrossLength_m = 10;

// The untouched footage where composing fails for want of OpenGL or memory.
Result<ComposedFrame> composed(const Scene& scene, int frame, const Frame& background, ComposeContext& context,
                               Stages stages) {
  return guarded([&] { return compose_frame(scene, frame, background, context, stages); }, "composing");
}

// Shares everything large with the scene it is made from.
Scene with_method(const Scene& scene, MethodChoice method) {
  Scene other = scene;
  other.compositing.method = method;
  return other;
}

}  // namespace

void SceneRenderer::keep(const std::shared_ptr<const Model>& model) {
  std::erase(drawn_, model);
  drawn_.push_back(model);
}

void SceneRenderer::drop_unused(std::size_t in_use) {
  while (drawn_.size() > in_use + kModelsKept) {
    context_.forget(drawn_.front()->mesh);
    drawn_.pop_front();
  }
}

std::shared_ptr<const OpenedScene> SceneRenderer::opened(const Revision& revision,
                                                         std::shared_ptr<const Footage> footage) {
  DraftScene draft = draft_scene(*revision.project, footage->shape, files_);
  for (const std::shared_ptr<const Model>& model : draft.scene.models) keep(model);
  drop_unused(draft.scene.models.size());
  return std::make_shared<const OpenedScene>(OpenedScene{.revision = revision.number,
                                                         .project = revision.project,
                                                         .footage = std::move(footage),
                                                         .draft = std::move(draft)});
}

std::shared_ptr<const PreviewImage> SceneRenderer::image(const OpenedScene& opened, int frame,
                                                         const DecodedFrame& footage, Stages stages,
                                                         std::optional<MethodChoice> method) {
  const Scene& own = opened.draft.scene;
  auto image = std::make_shared<PreviewImage>(
      PreviewImage{.revision = opened.revision, .frame = frame, .method = method, .problem = footage.problem});
  Result<ComposedFrame> made = method ? composed(with_method(own, *method), frame, footage.frame, context_, stages)
                                      : composed(own, frame, footage.frame, context_, stages);
  if (!made) {
    image->bgr = bgr_of(footage.frame);
    image->truth = {.index = frame, .time_s = time_of_frame_s(own.footage, frame)};
    image->problem = made.error().text();
    return image;
  }
  image->bgr = bgr_of(made->image);
  image->mask = made->mask;
  image->truth = std::move(made->truth);
  image->stages = std::move(made->stages);
  image->times = made->times;
  return image;
}

std::shared_ptr<const ModelImage> SceneRenderer::model_image(const Project& project,
                                                             const PreviewRequest::Turntable& wanted) {
  const Project clean = sanitized(project);
  const auto intruder = static_cast<std::size_t>(wanted.intruder);
  const ModelSettings& settings = clean.intruders[intruder].model;
  auto image =
      std::make_shared<ModelImage>(ModelImage{.file = resolved(project, settings.file), .turn_rad = wanted.turn_rad});
  const OrProblem<std::shared_ptr<const Model>> made = scene_model(clean, intruder, files_);
  if (!made) image->problem = made.error().what;
  const std::shared_ptr<const Model> model =
      made ? *made : files_.cross(settings.length_m > 0 ? settings.length_m : kCrossLength_m);
  keep(model);
  image->size_m = glm::dvec3(model->mesh.high_m) - glm::dvec3(model->mesh.low_m);
  const Result<Renderer*> renderer = context_.renderer();
  const Result<cv::Mat> rgba = renderer ? turntable_image(model->mesh, wanted.turn_rad, wanted.size_px, **renderer)
                                        : Result<cv::Mat>(fail(renderer.error()));
  if (rgba)
    image->rgba = *rgba;
  else
    image->problem = rgba.error().text();
  return image;
}

}  // namespace sigs::editor
