// SPDX-License-Identifier: MIT
#include "editor/preview/outline_truth.h"

#include <algorithm>
#include <utility>

#include "project/project.h"
#include "scene/opened_project.h"
#include "scene/scene.h"

namespace sigs::editor {

namespace {

TargetFrame target_frame_of(const VisibilityEstimate& estimate, const cv::Rect& image) {
  TargetFrame frame{.amodal_box = estimate.silhouette, .distance_m = estimate.distance_m};
  const bool is_visible = estimate.visibility_state == VisibilityState::in_view ||
                          estimate.visibility_state == VisibilityState::partly_occluded;
  if (!is_visible || !estimate.silhouette) return frame;
  const cv::Rect pixels = pixels_touched(*estimate.silhouette, 0, image);
  if (pixels.empty()) return frame;
  frame.visible = box_of(pixels);
  frame.visible_fraction = 1;
  return frame;
}

}  // namespace

FootageTruth footage_truth_of(const OpenedScene& scene) {
  const Scene& opened = scene.draft.scene;
  const FrameRange range{opened.first_frame, opened.last_frame};
  if (scene.footage && scene.footage->video) return footage_truth(*scene.footage->video, range);
  return {.size_px = opened.footage.size_px, .first_frame = range.first, .last_frame = range.last};
}

std::shared_ptr<const ClipTruth> outline_truth(const OpenedScene& scene,
                                               const std::vector<std::shared_ptr<const Survey>>& surveys) {
  const Scene& opened = scene.draft.scene;
  const int first = opened.first_frame;
  const int count = opened.last_frame - first + 1;
  ClipTruth clip{.footage = footage_truth_of(scene)};
  for (int i = 0; i < count; ++i) clip.times_s.push_back(time_of_frame_s(opened.footage, first + i));
  const cv::Rect image({0, 0}, opened.footage.size_px);
  for (std::size_t i = 0; i < scene.draft.intruder_of_project.size(); ++i) {
    const int id = scene.draft.intruder_of_project[i];
    if (id < 0) continue;
    const Survey* const survey = i < surveys.size() ? surveys[i].get() : nullptr;
    if (survey == nullptr || survey->first_frame != first || static_cast<int>(survey->estimates.size()) != count)
      return nullptr;
    TargetTruth target{.id = id, .name = opened.intruders[static_cast<std::size_t>(id)].name};
    for (const VisibilityEstimate& estimate : survey->estimates)
      target.frames.push_back(target_frame_of(estimate, image));
    clip.targets.push_back(std::move(target));
  }
  std::sort(clip.targets.begin(), clip.targets.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return std::make_shared<const ClipTruth>(std::move(clip));
}

}  // namespace sigs::editor
