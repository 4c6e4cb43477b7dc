// SPDX-License-Identifier: MIT
#pragma once

#include "video/frame_source.h"
#include "video/libav/demuxer.h"
#include "video/libav/frame_order.h"
#include "video/libav/orientation.h"
#include "video/libav/packet_table.h"

namespace sigs::libav {

// Nominal frame rate, 25/1 where nothing tells.
[[nodiscard]] AVRational frame_rate_of(const Demuxer& demuxer);

// Everything but the time stamps' own warnings: from the container, and from the first image as it is decoded.
// Sizes and sites are those of the upright image.
[[nodiscard]] VideoInfo video_info_of(const std::filesystem::path& path, const Demuxer& demuxer,
                                      const PacketTable& table, const FrameOrder& order, const AVFrame& first,
                                      const Orientation& orientation);

}  // namespace sigs::libav
