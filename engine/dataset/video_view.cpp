// SPDX-License-Identifier: MIT
#include "dataset/video_view.h"

#include <map>

#include "export.h"
#include "outlook.h"
#include "scene/scene.h"
#include "scene/scene_files.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

// Opens scenes, each file once.
class Viewer {
 public:
  std::optional<Visibility> view_of(const Project& project, int frames) {
    const std::optional<FootageShape> footage = shape_of_footage(resolved(project, project.footage.video).string());
    if (!footage) return std::nullopt;
    const Result<Scene> scene = open_scene(project, *footage, files_);
    if (!scene || scene->intruders.empty()) return std::nullopt;
    return estimated_visibilities(*scene, frames).front();
  }

 private:
  std::optional<FootageShape> shape_of_footage(const std::string& path) {
    if (const auto known = shapes_.find(path); known != shapes_.end()) return known->second;
    const Result<FrameSource> source = FrameSource::open(path);
    return shapes_[path] = source ? std::optional(shape_of(source->info())) : std::nullopt;
  }

  SceneFiles files_;
  std::map<std::string, std::optional<FootageShape>> shapes_;
};

}  // namespace

std::vector<std::optional<Visibility>> views_of(const std::vector<const PlannedVideo*>& videos, int frames,
                                               const std::atomic<bool>* cancel) {
  Viewer viewer;
  std::vector<std::optional<Visibility>> views(videos.size());
  for (std::size_t i = 0; i < videos.size() && !(cancel != nullptr && *cancel); ++i)
    views[i] = viewer.view_of(videos[i]->project, frames);
  return views;
}

}  // namespace sigs
