// SPDX-License-Identifier: MIT
#pragma once

#include "video/frame.h"

namespace sigs::accuracy {

// A smooth sky over smooth ground with a little grain, in PixelLayout::rgb: chroma that pixels share would add an error
// of the footage's own to every method.
[[nodiscard]] Frame background(cv::Size size_px);

}  // namespace sigs::accuracy
