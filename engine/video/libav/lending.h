// SPDX-License-Identifier: MIT
#pragma once

#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// Whether a picture of this format can stand on a frame's planes as they are: 8 bits a sample, each plane by itself.
[[nodiscard]] bool can_lend(AVPixelFormat format);

// Makes the frame's samples the picture's, without copying. They live at least as long as the picture and every
// reference to it; FFmpeg is told that it must not write them.
//   picture  has its format and size but no samples; the format can_lend() and has the frame's layout
void lend(AVFrame& picture, const Frame& frame);

}  // namespace sigs::libav
