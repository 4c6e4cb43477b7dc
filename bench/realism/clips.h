// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "video/frame_source.h"

namespace sigs::bench {

// A clip of a real aircraft with a box in each frame.
struct RealClip {
  std::string name;
  std::filesystem::path path;
  bool is_helicopter = false;
  bool is_still = false;                  // a single image
  bool is_tuning = false;                 // settings may be chosen by it; false: it only tells how good they are
  std::vector<std::optional<Box>> boxes;  // loose, by frame; none: no aircraft
};

// The clips of aircraft in SIGS_TEST_DATA/track with boxes, by name. The tuning clips are those of the list in
// clips.cpp; others of the same runs of five numbers, which often show the same sky, are left out.
[[nodiscard]] std::vector<RealClip> real_clips();

// Those of SIGS_TEST_DATA/thermal, of a thermal camera; every second by name is for tuning.
[[nodiscard]] std::vector<RealClip> thermal_clips();

// The stills of SIGS_TEST_DATA/stills as clips of one frame each, with boxes drawn by hand: four raw gray images of a
// camera aloft (Airborne Object Tracking), four JPEG images of a towed glider's nose camera.
[[nodiscard]] std::vector<RealClip> real_stills();

// Stops the program where it cannot be opened.
[[nodiscard]] FrameSource opened(const std::filesystem::path& path);

// Writes a calibration file of a pinhole with this field of view across the image; its absolute path.
[[nodiscard]] std::filesystem::path written_pinhole(cv::Size size_px, double field_rad,
                                                    const std::filesystem::path& file);

}  // namespace sigs::bench
