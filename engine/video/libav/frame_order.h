// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "video/libav/frame_decoder.h"
#include "video/libav/packet_table.h"

namespace sigs::libav {

// Which packet makes the n-th picture, and when it is shown.
struct FrameOrder {
  std::vector<int> ordinals{};  // of each picture in order of presentation
  std::vector<bool>
      can_start{};  // decoding can begin at this picture's packet; all before it in presentation is not needed
  std::vector<double> times_s{};   // 0 for the first, increasing
  bool times_are_nominal = false;  // the container's time stamps are missing or do not increase
  bool intra_only = false;         // every packet makes its pictures alone
  bool in_fields = false;          // a picture may be made of two packets; it has the ordinal of the first
  bool decodes_ahead = false;      // the decoder works on several pictures at a time
  int reorder_depth = 0;           // DecoderSettings::reorder_depth
};

// From the packets alone, where each makes exactly one picture and carries its own time stamp.
[[nodiscard]] std::optional<FrameOrder> order_from_packets(const PacketTable& table, const AVFormatContext& format,
                                                           const AVStream& stream);

// By decoding all: codecs with hidden or doubled pictures, containers without time stamps or a trustworthy index.
[[nodiscard]] Result<FrameOrder> order_from_decoding(const PacketTable& table, FrameDecoder& pictures,
                                                     AVRational frame_rate);

}  // namespace sigs::libav
