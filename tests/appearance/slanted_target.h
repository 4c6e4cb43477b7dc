// SPDX-License-Identifier: MIT
#pragma once

#include "video/frame.h"

namespace sigs::test {

// How a camera that looks at a test chart shows it.
struct TargetCamera {
  double sigma_px = 0.8;  // of the lens' Gaussian, in linear light
  double sharpening = 0;
  double sharpening_px = 1.2;
  double noise = 0;         // code values, luma
  double chroma_sigma = 0;  // of a Gaussian over the chroma planes' samples
  double turn_deg = 0;      // of the chart, added to that of each square
  int seed = 1;
};

// Squares of grey and colour, turned by 5 to 40 degrees, on another grey; 480x360, 4:2:0, limited range. Drawn six
// times finer each way, blurred there by OpenCV in linear light, averaged over the pixels, and sharpened by OpenCV in
// code values.
[[nodiscard]] Frame slanted_target(const TargetCamera& camera);

}  // namespace sigs::test
