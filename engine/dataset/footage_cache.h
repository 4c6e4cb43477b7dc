// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/result.h"
#include "camera/camera.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"
#include "horizon/sky_map.h"
#include "project/project.h"
#include "scene/opened_project.h"
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
  BoxesByFrame real_aircraft = {};  // that the footage itself shows
};

// Opens the files that each background names. Result: one entry for each background, in order; an entry is an error
// where its clip cannot be opened. The whole is an error where no clip can be opened, or where any other file of a
// background (calibration, mask, attitudes) is wrong. Errors name the recipe and the key.
[[nodiscard]] Result<std::vector<Result<OpenedBackground>>> opened_backgrounds(const Recipe& recipe);

// Share of a box from which on all of it counts as before sky, or before land.
inline constexpr double kNearlyAll = 0.98;

// Estimates of how the intruder of a planned video will be visible, and before what. Keeps what it has opened. For one
// thread at a time.
class VideoVisibility {
 public:
  // Makes it unnecessary to open a clip. Paths are absolute.
  void remember(const FootageSettings& footage, const FootageShape& shape);

  // Visibility of the first intruder, estimated without rendering it (scene/visibility.h). Evaluates up to
  // `frames` frames, and all of them where none of these shows the intruder. None where the files that the project
  // names cannot be opened.
  [[nodiscard]] std::optional<Visibility> visibility_of(const Project& project, int frames);

  // What is known of the project's last intruder in a frame of the footage. None as above. Soon told where nothing but
  // this intruder's flight differs from the project that was asked for before.
  [[nodiscard]] std::optional<VisibilityEstimate> last_intruder_at(const Project& project, int frame);

  // Finds the sky in frames of footage (horizon/sky_map.h), which are decoded. Errors as FrameSource::read();
  // interrupted.
  [[nodiscard]] Result<void> look_for_sky(const FootageSettings& footage, const std::set<int>& frames,
                                          const std::atomic<bool>* cancel);

  // What is behind a box of the image; beside the image its nearest place counts. Neither sky nor land is, among
  // others, what lies below clouds, at which the sky that is found ends. None: the frame was not looked at.
  struct Behind {
    double sky = 0;   // share of the box, 0..1
    double land = 0;  // likewise: lower than all sky within a quarter of the image's width
  };
  [[nodiscard]] std::optional<Behind> behind(const FootageSettings& footage, int frame, const Box& box) const;

  // The opened project, with models that have bounds and outermost points alone (scene/model.h): enough for estimates.
  // None where the files that it names cannot be opened.
  [[nodiscard]] std::optional<Scene> scene_of(const Project& project);

 private:
  struct Opened {
    Project project;
    Scene scene;
  };
  [[nodiscard]] std::optional<FootageShape> shape_of_footage(const FootageSettings& footage);
  [[nodiscard]] bool last_differs_by_a_flight(const Project& project);  // then last_ is made to have it

  SceneFiles files_;
  std::optional<Opened> last_;                                // that was asked for by last_intruder_at()
  std::map<FootageKey, std::optional<FootageShape>> shapes_;  // by what decides its frames; none: it cannot be opened
  struct Sky {
    SkyMap map;
    double scale = 1;  // of the reduced image in which it was found
  };
  std::map<std::pair<FootageKey, int>, Sky> skies_;  // by footage and frame
};

// Number of frames of an export of the project from this footage. Error bad_project: the footage has not the frames
// that the project names.
[[nodiscard]] Result<int> frames_of(const Project& project, const FootageShape& footage);

// What the export of a project reads of its footage.
struct ExportExtent {
  FrameRange frames;
  cv::Size footage_px;  // size of its images
};

// The extents of exports. Each clip is opened once. May be called from any thread.
class ExportExtents {
 public:
  explicit ExportExtents(const std::atomic<bool>* cancel = nullptr) : cancel_(cancel) {}

  // Errors: those of opening the clip; bad_project: it has not the frames that the project names.
  [[nodiscard]] Result<ExportExtent> of(const Project& project);

 private:
  std::mutex mutex_;
  std::map<FootageKey, Result<FootageShape>> shapes_;  // by what decides its frames
  const std::atomic<bool>* cancel_;
};

// Number of frames that are evaluated of each video when a dataset is planned or listed.
inline constexpr int kVisibilityFrames = 20;

// One estimate for each video, in order; none as above, and for all videos after `cancel` was set.
[[nodiscard]] std::vector<std::optional<Visibility>> visibilities_of(const std::vector<const PlannedVideo*>& videos,
                                                                     int frames, const std::atomic<bool>* cancel);

}  // namespace sigs
