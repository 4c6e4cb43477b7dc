// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "video/libav/decoder.h"
#include "video/libav/packet_reader.h"

namespace sigs::libav {

// A decoded picture and the packet it was made from.
struct Picture {
  FramePtr frame;
  int ordinal = 0;
  bool damaged = false;
};

// Pictures in order of presentation, from any packet on.
class PictureStream {
 public:
  PictureStream(PacketReader reader, const PacketTable& table) : reader_(std::move(reader)), table_(&table) {}

  [[nodiscard]] const Demuxer& demuxer() const { return reader_.demuxer(); }

  [[nodiscard]] Result<void> start(int ordinal, const DecoderSettings& settings);

  // Empty at the end.
  [[nodiscard]] Result<std::optional<Picture>> next();

  // Ordinal of the last packet that went in since start(), and of the first that was damaged, as far as met.
  [[nodiscard]] int fed() const { return fed_; }
  [[nodiscard]] std::optional<int> first_damage() const { return first_damage_; }

 private:
  [[nodiscard]] Result<void> feed();
  [[nodiscard]] Picture taken(FramePtr frame);
  void note_damage(int ordinal);
  void note_complaint();

  PacketReader reader_;
  const PacketTable* table_;
  // What the decoder talks of. With several threads flags on pictures get lost in FFmpeg 5.1; this does not.
  std::unique_ptr<Complaint> complaint_ = std::make_unique<Complaint>(false);
  CodecPtr decoder_;
  PacketPtr packet_ = new_packet();
  int fed_ = -1;
  std::optional<int> first_damage_;
  int complained_of_ = -1;  // an intra-only codec's packet; others flag their pictures themselves
};

}  // namespace sigs::libav
