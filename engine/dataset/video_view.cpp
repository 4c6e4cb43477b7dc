// SPDX-License-Identifier: MIT
#include "dataset/video_view.h"

#include <algorithm>
#include <cmath>
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
  std::optional<VideoView> view_of(const Project& project, int frames) {
    const std::optional<FootageShape> footage = shape_of_footage(resolved(project, project.footage.video).string());
    if (!footage) return std::nullopt;
    const Result<Scene> scene = open_scene(project, *footage, files_);
    if (!scene || scene->intruders.empty()) return std::nullopt;
    const VideoView view = view_in(*scene, frames);
    // Nobody is told that it is never seen because it was seen between two frames looked at.
    return view.in_view > 0 ? view : view_in(*scene, scene->last_frame - scene->first_frame + 1);
  }

 private:
  static VideoView view_in(const Scene& scene, int frames) {
    const OutlookPoints points(scene);
    const int length = scene.last_frame - scene.first_frame;
    VideoView view{.looked_at = std::min(frames, length + 1)};
    for (int i = 0; i < view.looked_at; ++i) {
      const double share = view.looked_at > 1 ? double(i) / (view.looked_at - 1) : 0;
      const Outlook seen = points.at(0, scene.first_frame + static_cast<int>(std::lround(share * length)));
      if (seen.sighting == Sighting::out_of_view || seen.sighting == Sighting::hidden) continue;
      view.smallest_px = view.in_view > 0 ? std::min(view.smallest_px, seen.size_px) : seen.size_px;
      view.largest_px = std::max(view.largest_px, seen.size_px);
      ++view.in_view;
    }
    return view;
  }

  std::optional<FootageShape> shape_of_footage(const std::string& path) {
    if (const auto known = shapes_.find(path); known != shapes_.end()) return known->second;
    const Result<FrameSource> source = FrameSource::open(path);
    return shapes_[path] = source ? std::optional(shape_of(source->info())) : std::nullopt;
  }

  SceneFiles files_;
  std::map<std::string, std::optional<FootageShape>> shapes_;
};

}  // namespace

std::vector<std::optional<VideoView>> views_of(const std::vector<const PlannedVideo*>& videos, int frames,
                                               const std::atomic<bool>* cancel) {
  Viewer viewer;
  std::vector<std::optional<VideoView>> views(videos.size());
  for (std::size_t i = 0; i < videos.size() && !(cancel != nullptr && *cancel); ++i)
    views[i] = viewer.view_of(videos[i]->project, frames);
  return views;
}

}  // namespace sigs
