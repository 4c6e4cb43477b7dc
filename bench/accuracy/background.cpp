// SPDX-License-Identifier: MIT
#include "accuracy/background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace sigs::accuracy {

namespace {

constexpr int kGrain = 3;  // code values to either side

// -kGrain..kGrain, the same for the same place in every run.
int grain(int x, int y, int plane) {
  std::uint32_t hash = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA77U ^
                       static_cast<std::uint32_t>(plane) * 0xC2B2AE3DU;
  hash ^= hash >> 15;
  hash *= 0x2C1B3C6DU;
  hash ^= hash >> 13;
  return static_cast<int>(hash % (2 * kGrain + 1)) - kGrain;
}

// From blue above through haze to green, with a soft horizon half-way down.
double smooth_code(double down, std::size_t plane) {
  constexpr std::array<double, 3> kOverhead{92, 132, 188};
  constexpr std::array<double, 3> kHaze{188, 200, 212};
  constexpr std::array<double, 3> kGround{84, 96, 62};
  const double sky = kOverhead[plane] + (kHaze[plane] - kOverhead[plane]) * std::min(2 * down, 1.0);
  const double is_ground = 1 / (1 + std::exp(-(down - 0.52) / 0.01));
  return sky + (kGround[plane] - sky) * is_ground;
}

}  // namespace

Frame background(cv::Size size_px) {
  Frame frame{.layout = PixelLayout::rgb, .color = {.range = ColorRange::full}};
  for (std::size_t plane = 0; plane < 3; ++plane) {
    frame.planes[plane] = cv::Mat(size_px, CV_8UC1);
    for (int y = 0; y < size_px.height; ++y) {
      const double smooth = smooth_code((y + 0.5) / size_px.height, plane);
      for (int x = 0; x < size_px.width; ++x)
        frame.planes[plane].at<uchar>(y, x) = cv::saturate_cast<uchar>(smooth + grain(x, y, static_cast<int>(plane)));
    }
  }
  return frame;
}

}  // namespace sigs::accuracy
