// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/plan.h"
#include "scene/scene.h"
#include "scene/scene_files.h"
#include "scene/visibility.h"

namespace sigs {

// Looks at planned videos one after the other; each file that they name is opened once. For one thread at a time.
class VideoVisibility {
 public:
  // Spares opening a clip that has been opened; video: as the project has it, absolute.
  void remember(const std::string& video, const FootageShape& shape);

  // How the intruder is seen, estimated without rendering it (outlook.h). None where what the project names cannot be
  // opened. Looks at up to `frames` frames, at all where none of these shows the intruder.
  [[nodiscard]] std::optional<Visibility> visibility_of(const Project& project, int frames);

 private:
  [[nodiscard]] std::optional<FootageShape> shape_of_footage(const std::string& path);

  SceneFiles files_;
  std::map<std::string, std::optional<FootageShape>> shapes_;
};

// How many frames of a video are looked at, for telling how its intruder is seen.
inline constexpr int kVisibilityFrames = 20;

// For each video, in order; none where what its project names cannot be opened, or after cancel. Looks at up to
// `frames` frames of each.
[[nodiscard]] std::vector<std::optional<Visibility>> visibilities_of(const std::vector<const PlannedVideo*>& videos,
                                                                     int frames, const std::atomic<bool>* cancel);

}  // namespace sigs
