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

  // Ordinal of the last packet that went in since start(), and whether anything was damaged since.
  [[nodiscard]] int fed() const { return fed_; }
  [[nodiscard]] bool met_damage() const { return met_damage_; }

 private:
  [[nodiscard]] Result<void> feed();
  [[nodiscard]] Picture taken(FramePtr frame);

  PacketReader reader_;
  const PacketTable* table_;
  CodecPtr decoder_;
  PacketPtr packet_ = new_packet();
  int fed_ = -1;
  bool met_damage_ = false;
};

}  // namespace sigs::libav
