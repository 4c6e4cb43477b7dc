// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "occlusion/detect.h"
#include "own_body/clips.h"

namespace sigs::bench {

// What one run of the detection said, and what it took.
struct Finding {
  OwnBody body;        // empty where nothing could be told
  std::string cannot;  // why nothing could be told; empty where a mask came out
  double wall_s = 0;   // from the open file to the mask
  double cpu_s = 0;    // of all threads
};

[[nodiscard]] Finding found_in(const Clip& clip, const OwnBodySettings& settings, KeepStages stages = KeepStages::no);

// Seconds that decoding frames 0..count-1 takes and nothing else, by the very means the detection has.
struct Taken {
  double wall_s = 0;
  double cpu_s = 0;
};
[[nodiscard]] Taken decoding_alone(const Clip& clip, int count);

// Intersection over union with what is true. Where nobody can tell, saying so is 1 and any mask 0.
[[nodiscard]] double agreement(const Finding& finding, const Clip& clip);

[[nodiscard]] OwnBodySettings with_method(OwnBodyMethod method, int frames);
[[nodiscard]] const char* name_of(OwnBodyMethod method);

// What the footage shows under a mask: the mask's outline and a tint. CV_8UC3.
[[nodiscard]] cv::Mat overlay(const cv::Mat& bgr, const cv::Mat& mask, const cv::Mat& truth);

// Stops the program where it cannot be written.
void write_image(const std::filesystem::path& path, const cv::Mat& image);

}  // namespace sigs::bench
