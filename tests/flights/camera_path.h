// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace sigs::flights {

// Where the camera is and how it looks. World axes X north, Y east, Z down; camera axes X forward, Y right, Z down.
// A pixel (x, y) sees along the camera ray (1, (x - cx) / f, (y - cy) / f), (cx, cy) being the middle of the image.
struct View {
  cv::Size size_px;
  double focal_px = 1;
  cv::Vec3d position_m;  // world
  cv::Matx33d world_from_camera;
};

// A straight flight with gentle lateral and angular oscillation at some 20 m/s, 25 frames a second.
struct Path {
  double height_m = 120;
  double weave_m = 60;           // to either side
  double sway = 1;               // of the attitude; 1: banks to 6 degrees
  double pitch_deg = -12;        // mean
  double first_pitch_deg = -12;  // until frame `level_from`, then it noses down within a second
  int level_from = 0;
  bool still = false;      // stands where frame 0 is
  std::uint32_t seed = 1;  // where it begins, and the phases
};

[[nodiscard]] View view_at(const Path& path, cv::Size size_px, int frame);

}  // namespace sigs::flights
