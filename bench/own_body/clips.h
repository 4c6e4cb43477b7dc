// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "flights/flights.h"
#include "video/frame_source.h"

namespace sigs::bench {

// A video file and, where it is known, the own body in it.
struct Clip {
  std::string name;
  std::filesystem::path path;
  cv::Mat own_body;  // CV_8UC1, 255: own body; empty: not known
  bool is_decidable = true;
};

inline constexpr int kCrf = 20;  // of the H.264 files, as from a camera

// Writes image(0), image(1), ... (CV_8UC3) as H.264, 25 frames a second.
void write_h264(const std::filesystem::path& path, cv::Size size_px, int frames,
                const std::function<cv::Mat(int)>& image);

// The flight as a file in the folder; made anew, since what draws flights may have changed.
[[nodiscard]] Clip encoded_clip(const flights::Flight& flight, int frames, const std::filesystem::path& folder);

// Stops the program where it cannot be opened.
[[nodiscard]] FrameSource opened(const std::filesystem::path& path);

}  // namespace sigs::bench
