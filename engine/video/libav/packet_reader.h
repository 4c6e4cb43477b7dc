// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <optional>

#include "video/libav/demuxer.h"
#include "video/libav/packet_table.h"

namespace sigs::libav {

// Packets from any ordinal on. What a seek of the container lands on is checked against the table; where it cannot be
// trusted the file is read from its start, which costs reading but no decoding.
class PacketReader {
 public:
  PacketReader(std::filesystem::path path, Demuxer demuxer, const PacketTable& table)
      : path_(std::move(path)), demuxer_(std::move(demuxer)), table_(&table) {}

  [[nodiscard]] const Demuxer& demuxer() const { return demuxer_; }

  // The next packet will be this one.
  [[nodiscard]] Result<void> go_to(int ordinal);

  // The next packet's ordinal, empty at the end.
  [[nodiscard]] Result<std::optional<int>> next(AVPacket& packet);

 private:
  [[nodiscard]] bool seek_before(int ordinal);
  [[nodiscard]] Result<bool> read_on();
  [[nodiscard]] Error changed() const;
  void keep();
  [[nodiscard]] Result<void> reopen();

  std::filesystem::path path_;
  Demuxer demuxer_;
  const PacketTable* table_;
  int met_ = -1;                  // ordinal of the packet last taken from the demuxer
  int wanted_ = 0;                // ordinal that next() gives
  int read_ = -1;                 // ordinal behind the newest packet in recent_; -1: nothing is read
  std::deque<PacketPtr> recent_;  // the last packets, so that a step back needs no seek
  size_t recent_bytes_ = 0;
  bool held_ = false;   // the packet met_ was read to see where a seek landed
  bool sought_ = true;  // not read straight from the file's start; the first pass leaves the demuxer at the end
  PacketPtr packet_ = new_packet();
};

}  // namespace sigs::libav
