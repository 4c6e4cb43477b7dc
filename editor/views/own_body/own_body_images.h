// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "editor/preview/background_job.h"
#include "editor/views/stages/stage_tiles.h"

namespace sigs::editor {

// A detection's confidence (CV_16UC1) in colours, CV_8UC3: blue where it is surely world, grey where nobody can tell,
// the own body's own colour where it is surely that; linear between.
[[nodiscard]] cv::Mat confidence_image(const cv::Mat& confidence);

// The stages in their order.
[[nodiscard]] std::vector<StageTile> stage_tiles(const OwnBody& found);

// "12.3 % of the image"
[[nodiscard]] std::string share_text(double share);
// "Found in 800 frames, settled early"
[[nodiscard]] std::string result_text(const OwnBody& found);
// Why a person should look twice before he believes it; empty: no reason. seconds: of footage that was looked through.
[[nodiscard]] std::vector<std::string> doubts_about(const OwnBody& found, double seconds);
// "120 of 800 frames, 0:05 left"
[[nodiscard]] std::string progress_text(const DetectionState& state);

}  // namespace sigs::editor
