// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::test {

// One decoded image's planes as FFmpeg gives them, CV_8UC1 each.
struct RawImage {
  std::vector<cv::Mat> planes;
  double time_s = 0;  // presentation time in the file
};

// A video as FFmpeg's own libraries decode it, front to back, one thread: the truth for what was written.
struct RawVideo {
  std::vector<RawImage> images;
  bool is_full_range = false;
  int matrix = 2;  // ISO/IEC 23091-2 code points
  int primaries = 2;
  int transfer = 2;
};

// The first `most` images. Only planar 8-bit formats. A failure fails the test.
[[nodiscard]] RawVideo raw_video(const std::filesystem::path& path, int max_images);

}  // namespace sigs::test
