// SPDX-License-Identifier: MIT
#include "dataset/video_visibility.h"

#include <map>

#include "scene/opened_project.h"
#include "scene/visibility.h"
#include "video/frame_source.h"

namespace sigs {

void VideoVisibility::remember(const std::string& video, const FootageShape& shape) {
  shapes_[video] = shape;
}

std::optional<Visibility> VideoVisibility::visibility_of(const Project& project, int frames) {
  const std::optional<FootageShape> footage = shape_of_footage(resolved(project, project.footage.video).string());
  if (!footage) return std::nullopt;
  const Result<Scene> scene = open_scene(project, *footage, files_);
  if (!scene || scene->intruders.empty()) return std::nullopt;
  return estimated_visibilities(*scene, frames).front();
}

std::optional<FootageShape> VideoVisibility::shape_of_footage(const std::string& path) {
  if (const auto known = shapes_.find(path); known != shapes_.end()) return known->second;
  const Result<FrameSource> source = FrameSource::open(path);
  return shapes_[path] = source ? std::optional(shape_of(source->info())) : std::nullopt;
}

std::vector<std::optional<Visibility>> visibilities_of(const std::vector<const PlannedVideo*>& videos, int frames,
                                                       const std::atomic<bool>* cancel) {
  VideoVisibility estimator;
  std::vector<std::optional<Visibility>> visibilities(videos.size());
  for (std::size_t i = 0; i < videos.size() && !(cancel != nullptr && *cancel); ++i)
    visibilities[i] = estimator.visibility_of(videos[i]->project, frames);
  return visibilities;
}

}  // namespace sigs
