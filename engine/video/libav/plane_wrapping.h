// SPDX-License-Identifier: MIT
#pragma once

#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// Whether an image of this format can stand on a frame's planes as they are: 8 bits a sample, each plane by itself.
[[nodiscard]] bool can_wrap_planes(AVPixelFormat format);

// Makes the frame's samples the image's, without copying. They live at least as long as the image and every
// reference to it; FFmpeg is told that it must not write them.
//   image  has its format and size but no samples; the format can_wrap_planes() and has the frame's layout
void wrap_planes(AVFrame& image, const Frame& frame);

}  // namespace sigs::libav
