// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>

#include "annotation/annotation.h"
#include "base/result.h"
#include "project/project.h"

namespace sigs {

// One composed frame for those who look at it rather than write it.
struct FilmFrame {
  cv::Mat picture;  // CV_8UC3, BGR
  FrameTruth truth;
};

// Composes the frames of a project in order, as export would, and hands each to `see` on the calling thread. Ends early
// where that gives an error, and gives it back.
[[nodiscard]] Result<void> show_film(const Project& project, int jobs,
                                     const std::function<Result<void>(const FilmFrame&)>& see);

}  // namespace sigs
