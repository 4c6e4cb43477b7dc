// SPDX-License-Identifier: MIT
#pragma once

#include "video/frame_source.h"
#include "video/libav/demuxer.h"
#include "video/libav/packet_table.h"
#include "video/libav/picture_order.h"
#include "video/libav/turn.h"

namespace sigs::libav {

// Nominal frame rate, 25/1 where nothing tells.
[[nodiscard]] AVRational frame_rate_of(const Demuxer& demuxer);

// Everything but the time stamps' own warnings: from the container, and from the first picture as it is decoded.
// Sizes and sites are those of the upright picture.
[[nodiscard]] VideoInfo facts_of(const std::filesystem::path& path, const Demuxer& demuxer, const PacketTable& table,
                                 const PictureOrder& order, const AVFrame& first, const Turn& turn);

}  // namespace sigs::libav
