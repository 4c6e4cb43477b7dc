// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>

#include "video/frame.h"
#include "video/video_writer.h"

namespace sigs::test {

// Small footage whose every sample is known: rough land that slides to the left below a dark block at the bottom.
[[nodiscard]] cv::Mat flight_luma(int frame, cv::Size size_px = {96, 72});
[[nodiscard]] cv::Rect block_in(cv::Size size_px);

// Lossless, 4:2:0, 25 frames a second; luma of each frame as given, no colour.
void write_luma_clip(const std::filesystem::path& path, int frames, const std::function<cv::Mat(int)>& luma);
void write_flight(const std::filesystem::path& path, int frames = 40, cv::Size size_px = {96, 72});

}  // namespace sigs::test
