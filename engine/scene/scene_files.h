// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "camera/camera.h"
#include "scene/attitude_file.h"
#include "scene/scene.h"

namespace sigs {

// The files that scenes are made of, each read once: a scene that is opened anew after an edit reads only what has
// changed. A file is read again when its size or time of change on disk differ; an OBJ's materials and textures are
// read with it. For one thread at a time. Errors are those of the rooms that read; they are remembered too, until the
// file changes, but a file that cannot be opened is tried again each time. Keeps what scenes hold, and the last few
// things that none holds any more.
class SceneFiles {
 public:
  SceneFiles();
  SceneFiles(SceneFiles&&) noexcept;
  SceneFiles& operator=(SceneFiles&&) noexcept;
  ~SceneFiles();

  // Two calls with the same file and axes give the same object, which lives as long as anybody holds it.
  [[nodiscard]] Result<std::shared_ptr<const Model>> model(const std::filesystem::path& file, const ModelAxes& axes);
  [[nodiscard]] Result<Camera> camera(const std::filesystem::path& calibration, cv::Size footage_size_px,
                                      std::optional<LensModel> model = std::nullopt);
  [[nodiscard]] Result<std::vector<AttitudeAtFrame>> attitudes(const std::filesystem::path& file);
  // Shared: not to be written to.
  [[nodiscard]] Result<cv::Mat> own_body_mask(const std::filesystem::path& file, cv::Size footage_size_px);

  // What stands in for a model (scene/placeholders.h): the same object for the same length. length_m > 0.
  [[nodiscard]] std::shared_ptr<const Model> cross(double length_m);

 private:
  struct Caches;
  std::unique_ptr<Caches> caches_;
};

}  // namespace sigs
