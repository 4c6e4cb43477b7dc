// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

struct ColorReading {
  ColorInfo color;
  std::string remark;  // what the file states and SIGS cannot follow; empty: nothing
};

// What a decoded image says of its colours. Unstated: range limited (full for RGB, JPEG and plain gray), matrix
// BT.601 below 720 lines and BT.709 from there on, chroma at the left (midway for JPEG).
[[nodiscard]] ColorReading color_of(const AVFrame& image, AVCodecID codec, PixelLayout layout);

// Tags an encoder with what the footage states. Unstated stays unstated, so that a player guesses the same for both.
void tag(AVCodecContext& encoder, const ColorInfo& color, PixelLayout layout);

}  // namespace sigs::libav
