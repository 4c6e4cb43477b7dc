// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "video/frame_quantisers.h"
#include "video/libav/handles.h"
#include "video/libav/stream_info.h"

namespace sigs::libav {

// The quantisers of a decoded image, in the image as it is stored; null where neither the decoder nor the packet has
// told any.
//   image   its decoder had AV_CODEC_EXPORT_DATA_VIDEO_ENC_PARAMS set; 8-bit QPs are made of deeper ones
//   tables  of the image's packet, for JPEG; all 0: none
[[nodiscard]] std::shared_ptr<const FrameQuantisers> quantisers_of(const AVFrame& image, AVCodecID codec,
                                                                   const JpegTables& tables);

// The same for the upright image: the map of macroblocks is turned with it, and JPEG's tables where rows and columns
// are exchanged.
//   stored_px  size of the stored image
[[nodiscard]] std::shared_ptr<const FrameQuantisers> oriented(const std::shared_ptr<const FrameQuantisers>& quantisers,
                                                              cv::Size stored_px, const Orientation& orientation);

}  // namespace sigs::libav
