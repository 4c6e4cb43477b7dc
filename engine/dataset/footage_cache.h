// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "camera/camera.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"
#include "project/project.h"
#include "scene/scene.h"
#include "scene/scene_files.h"
#include "scene/visibility.h"

namespace sigs {

// What planning needs to know of the footage. No frame is decoded, and each clip is opened once.

// A background of a recipe: size and times of its footage, its camera, the frames that videos may use.
struct OpenedBackground {
  FootageShape footage;
  Camera lens;
  FrameRange frames;
};

// Opens the files that each background names. Result: one entry for each background, in order; an entry is an error
// where its clip cannot be opened. The whole is an error where no clip can be opened, or where any other file of a
// background (calibration, mask, attitudes) is wrong. Errors name the recipe and the key.
[[nodiscard]] Result<std::vector<Result<OpenedBackground>>> opened_backgrounds(const Recipe& recipe);

// Estimates of how the intruder of a planned video will be visible. Keeps what it has opened. For one thread at a time.
class VideoVisibility {
 public:
  // Makes it unnecessary to open a clip. Paths are absolute.
  void remember(const FootageSettings& footage, const FootageShape& shape);

  // Visibility of the first intruder, estimated without rendering it (scene/visibility.h). Evaluates up to
  // `frames` frames, and all of them where none of these shows the intruder. None where the files that the project
  // names cannot be opened.
  [[nodiscard]] std::optional<Visibility> visibility_of(const Project& project, int frames);

  // What is known of the project's last intruder in a frame of the footage. None as above.
  [[nodiscard]] std::optional<VisibilityEstimate> last_intruder_at(const Project& project, int frame);

  // The opened project, with models that have bounds and outermost points alone (scene/model.h): enough for estimates.
  // None where the files that it names cannot be opened.
  [[nodiscard]] std::optional<Scene> scene_of(const Project& project);

 private:
  [[nodiscard]] std::optional<FootageShape> shape_of_footage(const FootageSettings& footage);

  SceneFiles files_;
  std::map<std::string, std::optional<FootageShape>> shapes_;  // by video and its times; none: it cannot be opened
};

// Number of frames that are evaluated of each video when a dataset is planned or listed.
inline constexpr int kVisibilityFrames = 20;

// One estimate for each video, in order; none as above, and for all videos after `cancel` was set.
[[nodiscard]] std::vector<std::optional<Visibility>> visibilities_of(const std::vector<const PlannedVideo*>& videos,
                                                                     int frames, const std::atomic<bool>* cancel);

}  // namespace sigs
