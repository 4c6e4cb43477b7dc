// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "annotation/annotation.h"
#include "base/frame_range.h"
#include "base/result.h"
#include "project/project.h"

namespace sigs {

// One composed frame for those who look at it rather than write it.
struct FilmFrame {
  cv::Mat picture;  // CV_8UC3, BGR
  FrameTruth truth;
};

// The frames that an export of a project would write, in order, without writing them.
class Film {
 public:
  // Checks the project and opens what it names. frames: none: the project's own range; numbers are the footage's.
  //   cancel  set: opening and showing end soon with the error interrupted; null or longer alive than the film
  // Errors as export_project's.
  [[nodiscard]] static Result<Film> open(const Project& project, const std::optional<FrameRange>& frames = {},
                                         const std::atomic<bool>* cancel = nullptr);
  Film(Film&&) noexcept;
  Film& operator=(Film&&) noexcept;
  ~Film();

  // As a label file of that export has it.
  [[nodiscard]] const FootageTruth& footage() const;
  [[nodiscard]] const std::vector<Warning>& warnings() const;

  // Composes `jobs` frames side by side and hands each to `see`, on the calling thread. Ends early where that gives an
  // error, and gives it back. Returns how many frames of the footage were damaged.
  [[nodiscard]] Result<int> show(int jobs, const std::function<Result<void>(const FilmFrame&)>& see);

 private:
  struct Inside;
  explicit Film(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace sigs
