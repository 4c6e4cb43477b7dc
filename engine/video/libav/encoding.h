// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.h"
#include "video/libav/handles.h"
#include "video/video_writer.h"

namespace sigs::libav {

// How the footage's planes go into a codec.
struct Encoding {
  const char* encoder = "";  // FFmpeg's name
  AVPixelFormat pixel_format = AV_PIX_FMT_NONE;
  PixelLayout layout = PixelLayout::yuv420;  // of what is stored
  ColorInfo color;                           // of what is stored
};

// FFV1 stores every layout as it is. H.264 stores gray as 4:2:0 with neutral chroma, since few players take its gray
// profile, and RGB as 4:4:4 BT.709. MJPEG is what every reader of JPEG expects: full range, BT.601, chroma midway.
// Error usage: the codec does not go into the container, or cannot hold the size.
[[nodiscard]] Result<Encoding> encoding_for(const VideoFormat& format);

// The frame as the encoding stores it. Shares the samples where nothing changes.
[[nodiscard]] Frame stored(const Frame& frame, const Encoding& encoding);

}  // namespace sigs::libav
