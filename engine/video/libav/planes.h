// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/result.h"
#include "video/frame.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// The samples of FFmpeg's images as planes of 8 to 16 bits, and back.

// The layout and depth nearest to a decoder's pixel format, and a description of how the samples are converted; empty
// where they are not.
struct Conversion {
  PixelLayout layout = PixelLayout::yuv420;
  int bit_depth = 8;
  std::string text{};
};
[[nodiscard]] Conversion conversion_of(AVPixelFormat format);

// The image's samples as planes of the conversion's layout and depth. Integer formats of 8 to 16 bits keep every
// sample, packed or planar, of either byte order. All others go through swscale.
// Errors bad_data: the image's format has another layout or depth than `wanted`; swscale does not know the format.
[[nodiscard]] Result<Frame> frame_of(const AVFrame& image, const Conversion& wanted, const ColorInfo& color);

// The luma of such an image alone, as a gray frame, of formats with luma whose samples need no conversion; the whole
// frame of all others. Errors as above.
[[nodiscard]] Result<Frame> luma_frame_of(const AVFrame& image, const Conversion& wanted, const ColorInfo& color);

// The planar pixel format with a layout and depth, of this machine's byte order; packed 32 bits of RGB for 8-bit RGB
// where `packed_rgb`. AV_PIX_FMT_NONE where FFmpeg has none.
[[nodiscard]] AVPixelFormat pixel_format_of(PixelLayout layout, int bit_depth, bool packed_rgb = false);

// Copies the frame's samples into a writable image, whose pixel format has the frame's depth and layout.
void fill(AVFrame& image, const Frame& frame);

// Whether images of this format can use a frame's planes as they are: 8 bits or 16-bit words for each sample, each
// component in a plane of its own, in the order of a frame's planes.
[[nodiscard]] bool can_wrap_planes(AVPixelFormat format);

// Makes the image refer to the frame's samples without copying them. They live at least as long as the image and every
// reference to it; the buffers are marked as read-only.
//   image  has its format and size but no samples; the format satisfies can_wrap_planes() and has the frame's layout
void wrap_planes(AVFrame& image, const Frame& frame);

}  // namespace sigs::libav
