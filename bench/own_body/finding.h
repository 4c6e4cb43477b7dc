// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "flights/flights.h"
#include "occlusion/detect.h"
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

// The result of one run of the detection, and its time.
struct Finding {
  OwnBody body;        // empty where undecided
  std::string cannot;  // why undecided; empty where there is a mask
  double wall_s = 0;   // from the open file to the mask
  double cpu_s = 0;    // of all threads
};

[[nodiscard]] Finding found_in(const Clip& clip, const OwnBodySettings& settings, KeepStages stages = KeepStages::no);

// Seconds that decoding frames 0..count-1 takes and nothing else, with the detection's own decoder.
struct Taken {
  double wall_s = 0;
  double cpu_s = 0;
};
[[nodiscard]] Taken decoding_alone(const Clip& clip, int count);

// Intersection over union with the truth. Where the body cannot be determined, undecided is 1 and any mask 0.
[[nodiscard]] double agreement(const Finding& finding, const Clip& clip);

[[nodiscard]] OwnBodySettings with_method(OwnBodyMethod method, int frames);
[[nodiscard]] const char* name_of(OwnBodyMethod method);

// The footage with a mask's outline and a tint over it. CV_8UC3.
[[nodiscard]] cv::Mat overlay(const cv::Mat& bgr, const cv::Mat& mask, const cv::Mat& truth);

// Stops the program where it cannot be written.
void write_image(const std::filesystem::path& path, const cv::Mat& image);

}  // namespace sigs::bench
