// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <set>

#include "video/libav/decoder.h"
#include "video/libav/packet_reader.h"

namespace sigs::libav {

// A decoded image and the packet it was made from.
struct DecodedFrame {
  FramePtr frame;
  int ordinal = 0;
};

// Images in order of presentation, from any packet on.
class FrameDecoder {
 public:
  FrameDecoder(PacketReader reader, const PacketTable& table) : reader_(std::move(reader)), table_(&table) {}

  [[nodiscard]] const Demuxer& demuxer() const { return reader_.demuxer(); }

  // A fresh decoder gets the packets from this one on, as far as the one before `end`; none: all.
  [[nodiscard]] Result<void> start(int ordinal, const DecoderSettings& settings, std::optional<int> end = {});

  // Empty at the end.
  [[nodiscard]] Result<std::optional<DecodedFrame>> next();

  // Ordinal of the last packet that went in since start().
  [[nodiscard]] int fed() const { return fed_; }

  // The packets since start() that are damaged: the decoder complains of them, or the container or a checksum does.
  // Complete for all packets up to that of an image once it came out.
  [[nodiscard]] const std::set<int>& damaged() const { return damaged_; }

 private:
  [[nodiscard]] Result<void> feed();
  void note_damage(int ordinal);
  void note_decoder_errors();
  void note_refusal();

  PacketReader reader_;
  const PacketTable* table_;
  // With several threads flags on images get lost in FFmpeg 5.1; what the decoder talks of does not.
  std::unique_ptr<DecoderErrors> decoder_errors_ = std::make_unique<DecoderErrors>();
  CodecPtr decoder_;
  PacketPtr packet_ = new_packet();
  int fed_ = -1;
  int end_ = 0;
  std::deque<int> in_work_;  // packets whose outcome is not known yet, one a thread
  std::set<int> damaged_;
};

}  // namespace sigs::libav
