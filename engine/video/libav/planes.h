// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"
#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// The samples of FFmpeg's images as 8-bit planes, and back.

// The 8-bit layout nearest to a decoder's pixel format, and a description of how the samples are converted; empty where
// they are not.
struct Conversion {
  PixelLayout layout = PixelLayout::yuv420;
  std::string text{};
};
[[nodiscard]] Conversion conversion_of(AVPixelFormat format);

// The image's samples as 8-bit planes of the given layout. 8-bit formats keep every sample, packed or planar. Deeper
// ones are rounded to the nearest 8-bit code of the same range. All others go through swscale.
// Error bad_data where swscale does not know the format.
[[nodiscard]] Result<Frame> frame_of(const AVFrame& image, PixelLayout layout, const ColorInfo& color);

// Copies the frame's samples into a writable image, whose pixel format has 8 bits per sample and the frame's layout.
void fill(AVFrame& image, const Frame& frame);

// Whether images of this format can use a frame's planes as they are: 8 bits per sample, each component in a plane of
// its own.
[[nodiscard]] bool can_wrap_planes(AVPixelFormat format);

// Makes the image refer to the frame's samples without copying them. They live at least as long as the image and every
// reference to it; the buffers are marked as read-only.
//   image  has its format and size but no samples; the format satisfies can_wrap_planes() and has the frame's layout
void wrap_planes(AVFrame& image, const Frame& frame);

}  // namespace sigs::libav
