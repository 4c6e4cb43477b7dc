// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.h"
#include "video/libav/handles.h"
#include "video/video_writer.h"

namespace sigs::libav {

// How the footage's planes are stored in a codec.
struct Encoding {
  const char* encoder = "";  // FFmpeg's name
  AVPixelFormat pixel_format = AV_PIX_FMT_NONE;
  PixelLayout layout = PixelLayout::yuv420;  // of the stored image
  int bit_depth = 8;                         // of the stored image
  ColorInfo color;                           // of the stored image
};

// FFV1 stores every layout as it is. H.264, HEVC and AV1 store gray as 4:2:0 with neutral chroma, since few players
// support their gray profiles, and RGB as 4:4:4 BT.709. MJPEG is what every reader of JPEG expects: full range, BT.601,
// chroma midway. The depth is the frames' one (at most format.max_bit_depth), else the next higher that the encoder has
// for the layout, else its highest.
// Error usage: the codec cannot be put into the container, or cannot store the size.
// Error unavailable: FFmpeg was built without the encoder, or it has no format of this layout.
[[nodiscard]] Result<Encoding> encoding_for(const VideoFormat& format);

// The frame as the encoding stores it. It shares the samples where nothing changes.
[[nodiscard]] Frame stored(const Frame& frame, const Encoding& encoding);

// Opens an encoder whose bytes do not depend on the machine or the number of threads.
//   tick     unit of the time stamps that it will be given
//   headers  the container stores the codec's parameters once, not in the stream
// Error unavailable: FFmpeg was built without the encoder, or the encoder refuses the format.
[[nodiscard]] Result<CodecPtr> open_encoder(const VideoFormat& format, const Encoding& encoding, AVRational tick,
                                            bool headers);

}  // namespace sigs::libav
