// SPDX-License-Identifier: MIT
#include "editor/preview/rig_preview.h"

#include <algorithm>
#include <utility>

#include "editor/preview/surveys.h"

namespace sigs::editor {

namespace {

// The request for a camera, by its own frames. Until its scene is open they are not known.
PreviewRequest in_own_frames(PreviewRequest request, const PreviewOutput& shown) {
  if (!shown.scene || !shown.scene->draft.scene.timeline) return request;
  const Scene& scene = shown.scene->draft.scene;
  request.frame = own_frame_at(scene, request.frame);
  request.range_first = own_frame_at(scene, request.range_first);
  request.range_last = own_frame_at(scene, request.range_last);
  return request;
}

}  // namespace

RigPreview::RigPreview(PreviewLimits limits, std::function<void()> wake) : limits_(limits), wake_(std::move(wake)) {
  cameras_.push_back({.previewer = std::make_unique<Previewer>(limits_, wake_)});
  shown_.resize(1);
}

// What is looked at has the memory; of the others a few images are kept, for when they are looked at again.
void RigPreview::share_memory(std::size_t active, bool all_images) {
  const std::size_t count = cameras_.size();
  const std::size_t aside = all_images ? limits_.cache_bytes / count : limits_.cache_bytes / (4 * count);
  for (std::size_t i = 0; i < count; ++i)
    cameras_[i].previewer->set_cache_bytes(i == active ? limits_.cache_bytes - (count - 1) * aside : aside);
}

void RigPreview::want(const Document& document, const Request& request) {
  const std::size_t count = std::max<std::size_t>(1, document.cameras().size());
  while (cameras_.size() < count) cameras_.push_back({.previewer = std::make_unique<Previewer>(limits_, wake_)});
  cameras_.resize(count);
  shown_.resize(count);
  const std::size_t active = document.active_camera();
  share_memory(active, request.all_images);
  for (std::size_t i = 0; i < count; ++i) {
    Camera& camera = cameras_[i];
    PreviewRequest wanted = request.active;
    if (i != active) {
      if (request.only_active && !request.all_images && camera.revision.number != 0) continue;
      const std::uint64_t number = document.state().number;
      const bool is_known = camera.revision.number != 0 && state_number(camera.revision.number) == number;
      if (!is_known) camera.revision = revision_of_camera(document.state(), i);
      wanted = {.revision = camera.revision,
                .frame = wanted.frame,
                .direction = wanted.direction,
                .range_first = wanted.range_first,
                .range_last = wanted.range_last,
                .playing = wanted.playing,
                .image = request.all_images};
    }
    camera.revision = wanted.revision;
    camera.previewer->want(in_own_frames(std::move(wanted), shown_[i]));
  }
}

void RigPreview::put_on_timeline(Camera& camera, PreviewOutput& shown, bool is_active) {
  if (!shown.scene || !shown.scene->draft.scene.timeline) return;
  const Scene& scene = shown.scene->draft.scene;
  if (camera.raw_surveys != shown.surveys) {
    camera.raw_surveys = shown.surveys;
    camera.surveys.clear();
    for (const std::shared_ptr<const Survey>& survey : shown.surveys)
      camera.surveys.push_back(on_timeline(survey, scene));
  }
  shown.surveys = camera.surveys;
  if (!is_active) return shown.cached.clear();
  const std::vector<bool> own = std::exchange(shown.cached, {});
  shown.cached.resize(scene.timeline->footage.times_s.size());
  const CountedFrames filmed = filmed_frames(scene);
  for (int frame = filmed.first_frame; frame <= filmed.last_frame; ++frame) {
    const auto i = static_cast<std::size_t>(own_frame_at(scene, frame));
    shown.cached[static_cast<std::size_t>(frame)] = i < own.size() && own[i];
  }
}

const std::vector<PreviewOutput>& RigPreview::shown(const Document& document) {
  shown_.resize(cameras_.size());
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    shown_[i] = cameras_[i].previewer->shown();
    const bool is_of_document = shown_[i].scene && state_number(shown_[i].scene->revision) >= document.first_number();
    if (shown_[i].scene && !is_of_document) shown_[i] = {};
    put_on_timeline(cameras_[i], shown_[i], i == document.active_camera());
  }
  return shown_;
}

void RigPreview::set_texture_bytes(std::size_t bytes) {
  for (Camera& camera : cameras_) camera.previewer->set_texture_bytes(bytes / cameras_.size());
}

void RigPreview::set_prefetch_paused(bool paused) {
  for (Camera& camera : cameras_) camera.previewer->set_prefetch_paused(paused);
}

}  // namespace sigs::editor
