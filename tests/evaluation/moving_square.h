// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "base/image.h"

namespace sigs::test {

// A textured patch that crosses textured ground, one pixel down and two to the right a frame. CV_8UC3.
[[nodiscard]] cv::Mat square_image(int frame);
[[nodiscard]] cv::Rect square_pixels(int frame);
[[nodiscard]] Box square_box(int frame);  // its edges

// The same ground without it.
[[nodiscard]] cv::Mat background_image();

}  // namespace sigs::test
