// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"
#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// The 8-bit layout nearest to a decoder's pixel format, and in words what becomes of the samples; empty: nothing.
struct Conversion {
  PixelLayout layout = PixelLayout::yuv420;
  std::string text{};
};
[[nodiscard]] Conversion conversion_of(AVPixelFormat format);

// The image's samples as 8-bit planes of the given layout. 8-bit formats keep every sample, packed or planar. Deeper
// ones are rounded to the nearest 8-bit code of the same range. Everything else goes through swscale.
// Error bad_data where swscale does not know the format.
[[nodiscard]] Result<Frame> frame_of(const AVFrame& image, PixelLayout layout, const ColorInfo& color);

// Fills the writable image, whose pixel format has 8 bits a sample and the frame's layout.
void fill(AVFrame& image, const Frame& frame);

}  // namespace sigs::libav
