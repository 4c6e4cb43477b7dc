// SPDX-License-Identifier: MIT
#pragma once

#include "flights/body.h"

namespace sigs::flights {

struct Painted {
  cv::Mat cover;          // CV_8UC1: share of each pixel, before the lens' softness
  cv::Mat premultiplied;  // CV_8UC4, slightly soft
};

// The parts one over the other, on a canvas larger than the image by the margin on each side.
[[nodiscard]] Painted painted_parts(const std::vector<Part>& parts, cv::Size size_px, int margin_px,
                                    std::uint32_t seed);

}  // namespace sigs::flights
