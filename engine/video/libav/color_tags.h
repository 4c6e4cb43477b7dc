// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// The colours of an image as its file states them, with what is assumed.
struct ColorReading {
  ColorInfo color;
  std::string remark;  // what the file states and SIGS does not support; empty: nothing
};

// The colours that a decoded image states. Where it states none: limited range (full for RGB, JPEG and gray outside the
// video standards), matrix BT.601 below 720 lines and BT.709 from there on, chroma at the left (midway for JPEG).
[[nodiscard]] ColorReading color_of(const AVFrame& image, AVCodecID codec, PixelLayout layout);

// Sets the encoder's colour tags to what the footage states. What is unstated stays unstated, so that a player assumes
// the same for both.
void tag(AVCodecContext& encoder, const ColorInfo& color, PixelLayout layout);

}  // namespace sigs::libav
