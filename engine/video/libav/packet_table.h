// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "video/libav/demuxer.h"

namespace sigs::libav {

// One packet of the video stream as the container describes it; AV_NOPTS_VALUE and -1 where it states nothing.
struct PacketMark {
  int64_t pts = AV_NOPTS_VALUE;  // presentation time, in the stream's ticks
  int64_t dts = AV_NOPTS_VALUE;  // decoding time
  int64_t file_position = -1;
  int size = 0;            // bytes
  bool key = false;        // decoding can begin here, according to the container
  bool discarded = false;  // decoded but not shown: an edit list starts after it
  bool corrupt = false;    // according to the container or a checksum
};

// All packets of a video stream in order of decoding. A packet's index in the table is its *ordinal*, by which all of
// libav/ refers to it.
class PacketTable {
 public:
  // Reads the file to its end.
  [[nodiscard]] static PacketTable read(Demuxer& demuxer);

  [[nodiscard]] int size() const { return static_cast<int>(marks_.size()); }
  [[nodiscard]] const PacketMark& operator[](int ordinal) const { return marks_[static_cast<size_t>(ordinal)]; }
  [[nodiscard]] bool any_corrupt() const;
  [[nodiscard]] bool broke_off() const { return broke_off_; }  // the file ends before its index does

  // The ordinal of a packet that was read after a seek, by its file position, size and time stamp. Nothing where they
  // do not identify it.
  [[nodiscard]] std::optional<int> ordinal_of(const AVPacket& packet) const;

  // Whether the packet is certainly the one of this ordinal: the file position is known and agrees.
  [[nodiscard]] bool matches(int ordinal, const AVPacket& packet) const;

  // Whether the packet can be the one of this ordinal; for use where the file position may be unknown.
  [[nodiscard]] bool looks_like(int ordinal, const AVPacket& packet) const;

 private:
  void sort_by_position();

  std::vector<PacketMark> marks_;
  std::vector<int> by_position_;  // ordinals
  bool broke_off_ = false;
};

}  // namespace sigs::libav
