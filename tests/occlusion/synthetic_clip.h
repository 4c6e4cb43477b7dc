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

// Soft clouds that pass behind a plain nose with a boom, whose edges alone are sharp: 640x480, seeded. The clouds are
// smoothed noise of 8 octaves and move by px_per_frame to the left, the paint is smoothed noise of 7 octaves. All codes
// swing by the share `exposure`; every sample has grain of standard deviation 3.
struct SoftClouds {
  bool has_body = true;
  double cloud_contrast = 60;  // codes from the darkest to the brightest
  double paint_contrast = 60;  // 0: plain grey
  int px_per_frame = 6;
  double exposure = 0;
  int frames = 160;
};
[[nodiscard]] cv::Mat soft_clouds_body();  // truth, CV_8UC1, 255: body
[[nodiscard]] std::function<cv::Mat(int)> soft_clouds_luma(const SoftClouds& settings);

// 4:2:0, 25 frames a second; luma of each frame as given, no colour: lossless, or H.264 by x264.
void write_h264_clip(const std::filesystem::path& path, int frames, int crf, const std::function<cv::Mat(int)>& luma);

// Lossless, 4:2:0, 25 frames a second; luma of each frame as given, no colour.
void write_luma_clip(const std::filesystem::path& path, int frames, const std::function<cv::Mat(int)>& luma);
void write_flight(const std::filesystem::path& path, int frames = 40, cv::Size size_px = {96, 72});

}  // namespace sigs::test
