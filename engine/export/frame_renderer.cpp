// SPDX-License-Identifier: MIT
#include "export/frame_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/threads.h"
#include "frame/compose_frame.h"
#include "scene/visibility.h"

namespace sigs {

FrameRenderer::FrameRenderer() : context_(std::make_unique<ComposeContext>()) {}
FrameRenderer::~FrameRenderer() = default;

Result<void> FrameRenderer::open_footage(const Project& project, const std::atomic<bool>* cancel) {
  const FootageKey key = footage_key(project);
  const Quantisers quantisers = quantisers_for(project);
  if (footage_ && footage_->key == key && footage_->quantisers == quantisers) return {};
  Result<FrameSource> source = sigs::open_footage(project, cancel, quantisers);
  if (const Result<void> on = check_interrupt(cancel); !on) return on;
  if (!source) return fail(footage_error(project, source.error()));
  project_.reset();  // the scene, if any, is that of other footage
  footage_.emplace(OpenedFootage{key, quantisers, std::move(*source)});
  return {};
}

Result<FrameRenderer::Opened> FrameRenderer::open(const Project& project, const std::atomic<bool>* cancel) {
  return guarded([&]() -> Result<Opened> {
    if (project_ && *project_ == project) return Opened{&footage_->source.info(), &*scene_, {}};
    if (const Result<void> valid = check_valid(project); !valid) return fail(valid.error());
    if (const Result<void> footage = open_footage(project, cancel); !footage) return fail(footage.error());
    const VideoInfo& info = footage_->source.info();
    Result<Scene> scene = open_valid_scene(project, footage_shape(project, info), files_);
    if (!scene) return fail(scene.error());
    // Meshes that the new scene lacks may be destroyed with the old one.
    if (scene_)
      for (const std::shared_ptr<const Model>& model : scene_->models)
        if (std::find(scene->models.begin(), scene->models.end(), model) == scene->models.end())
          context_->forget(model->mesh);
    std::vector<Warning> warnings = warnings_of(info);
    for (Warning& warning : codec_warnings_of(project, info)) warnings.push_back(std::move(warning));
    for (Warning& warning : warnings_of(project, *scene, {})) warnings.push_back(std::move(warning));
    project_ = project;
    scene_ = std::move(*scene);
    return Opened{&info, &*scene_, std::move(warnings)};
  });
}

Result<ComposedFrame> FrameRenderer::render(const Project& project, int frame, const GivenPoses& poses,
                                            const std::atomic<bool>* cancel) {
  return guarded([&]() -> Result<ComposedFrame> {
    const Result<Opened> opened = open(project, cancel);
    if (!opened) return fail(opened.error());
    const int count = opened->footage->frame_count();
    if (frame < 0 || frame >= count)
      return fail(fmt::format("frame {}", frame), fmt::format("the footage has frames 0 to {}", count - 1),
                  ErrorKind::usage);
    Result<Frame> background = footage_->source.read(frame);
    if (!background) return fail(background.error());
    std::optional<Scene> posed;
    if (!poses.empty()) {
      Result<Scene> scene = with_poses(*scene_, frame, poses);
      if (!scene) return fail(scene.error());
      posed = std::move(*scene);
    }
    Result<ComposedFrame> composed = compose_frame(posed ? *posed : *scene_, frame, std::move(*background), *context_);
    if (!composed) return fail(composing_error(project, composed.error()));
    return composed;
  });
}

}  // namespace sigs
