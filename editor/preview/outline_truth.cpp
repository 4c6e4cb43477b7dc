// SPDX-License-Identifier: MIT
#include "editor/preview/outline_truth.h"

#include <algorithm>
#include <utility>

#include "base/frame_range.h"
#include "opened_project.h"
#include "scene/scene.h"

namespace sigs::editor {

namespace {

TargetFrame target_frame_of(const Outlook& outlook, const cv::Rect& picture) {
  TargetFrame frame{.silhouette = outlook.silhouette, .distance_m = outlook.distance_m};
  const bool is_seen = outlook.sighting == Sighting::in_view || outlook.sighting == Sighting::partly_hidden;
  if (!is_seen || !outlook.silhouette) return frame;
  const cv::Rect pixels = pixels_touched(*outlook.silhouette, 0, picture);
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

std::shared_ptr<const FilmTruth> outline_truth(const OpenedScene& scene,
                                               const std::vector<std::shared_ptr<const Survey>>& surveys) {
  const Scene& opened = scene.draft.scene;
  const int first = opened.first_frame;
  const int count = opened.last_frame - first + 1;
  FilmTruth film{.footage = footage_truth_of(scene)};
  for (int i = 0; i < count; ++i) film.times_s.push_back(time_of_frame_s(opened.footage, first + i));
  const cv::Rect picture({0, 0}, opened.footage.size_px);
  for (std::size_t i = 0; i < scene.draft.intruder_of_project.size(); ++i) {
    const int id = scene.draft.intruder_of_project[i];
    if (id < 0) continue;
    const Survey* const survey = i < surveys.size() ? surveys[i].get() : nullptr;
    if (survey == nullptr || survey->first_frame != first || static_cast<int>(survey->outlooks.size()) != count)
      return nullptr;
    TargetTruth target{.id = id, .name = opened.intruders[static_cast<std::size_t>(id)].name};
    for (const Outlook& outlook : survey->outlooks) target.frames.push_back(target_frame_of(outlook, picture));
    film.targets.push_back(std::move(target));
  }
  std::sort(film.targets.begin(), film.targets.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return std::make_shared<const FilmTruth>(std::move(film));
}

}  // namespace sigs::editor
