// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "video/libav/demuxer.h"

namespace sigs::libav {

// One packet of the video stream as the container gives it; AV_NOPTS_VALUE and -1 where it says nothing.
struct PacketMark {
  int64_t pts = AV_NOPTS_VALUE;
  int64_t dts = AV_NOPTS_VALUE;
  int64_t file_position = -1;
  int size = 0;
  bool key = false;        // decoding can begin here, as the container says
  bool discarded = false;  // decoded but not shown: an edit list starts behind it
  bool corrupt = false;    // the container or a checksum says so
};

// All packets in decode order. A packet's place in it, its ordinal, is its name throughout this room.
class PacketTable {
 public:
  // Reads the file to its end.
  [[nodiscard]] static PacketTable read(Demuxer& demuxer);

  [[nodiscard]] int size() const { return static_cast<int>(marks_.size()); }
  [[nodiscard]] const PacketMark& operator[](int ordinal) const { return marks_[static_cast<size_t>(ordinal)]; }
  [[nodiscard]] bool any_corrupt() const;
  [[nodiscard]] bool broke_off() const { return broke_off_; }  // the file ends before its index does

  // The ordinal of a packet that was met after a seek, where the file position, size and time stamp tell it.
  [[nodiscard]] std::optional<int> ordinal_of(const AVPacket& packet) const;
  [[nodiscard]] bool matches(int ordinal, const AVPacket& packet) const;

  // The same where the file position is unknown: whether the packet can be the one of this ordinal.
  [[nodiscard]] bool looks_like(int ordinal, const AVPacket& packet) const;

 private:
  void sort_by_position();

  std::vector<PacketMark> marks_;
  std::vector<int> by_position_;  // ordinals
  bool broke_off_ = false;
};

}  // namespace sigs::libav
