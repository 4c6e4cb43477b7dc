// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "video/libav/demuxer.h"
#include "video/libav/frame_decoder.h"

namespace sigs::libav {

// Which packet gives the n-th image, and when it is shown.
struct FrameOrder {
  std::vector<int> ordinals{};  // of each image's packet, in order of presentation
  // For each image: decoding can begin at its packet, and gives it and all later images without the ones before.
  std::vector<bool> can_start{};
  std::vector<double> times_s{};   // 0 for the first, increasing
  bool times_are_nominal = false;  // the container's time stamps are missing or do not increase
  bool intra_only = false;         // every packet can be decoded alone
  bool in_fields = false;          // an image may consist of two packets; it has the ordinal of the first
  bool decodes_ahead = false;      // the decoder works on several images at a time
  int reorder_depth = 0;           // DecoderSettings::reorder_depth
};

// The order from the packets alone, where each gives exactly one image and has its own time stamp; else nothing.
[[nodiscard]] std::optional<FrameOrder> order_from_packets(const PacketTable& table, const AVFormatContext& format,
                                                           const AVStream& stream);

// The order found by decoding everything: for codecs with hidden or repeated images, and containers without time stamps
// or with an unreliable index.
//   frame_rate  spaces the images where the container has no usable times
[[nodiscard]] Result<FrameOrder> order_from_decoding(const PacketTable& table, FrameDecoder& images,
                                                     AVRational frame_rate);

}  // namespace sigs::libav
