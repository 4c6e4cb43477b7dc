// SPDX-License-Identifier: MIT
#include "video/libav/packet_reader.h"

#include <algorithm>

namespace sigs::libav {
namespace {

constexpr int kMostSeeks = 5;

// Before the keyframe's own packet in decode order; some containers seek by decode time, some by presentation time.
std::optional<int64_t> seek_time(const PacketMark& mark) {
  if (mark.pts == AV_NOPTS_VALUE && mark.dts == AV_NOPTS_VALUE) return {};
  if (mark.pts == AV_NOPTS_VALUE) return mark.dts;
  if (mark.dts == AV_NOPTS_VALUE) return mark.pts;
  return std::min(mark.pts, mark.dts);
}

int key_before(const PacketTable& table, int ordinal) {
  for (int i = ordinal - 1; i > 0; --i)
    if (table[i].key) return i;
  return 0;
}

}  // namespace

Result<void> PacketReader::reopen() {
  Result<Demuxer> demuxer = demuxer_.reopened(path_);
  if (!demuxer) return fail(demuxer.error());
  demuxer_ = std::move(*demuxer);
  met_ = -1;
  held_ = false;
  sought_ = false;
  return {};
}

bool PacketReader::seek_before(int ordinal) {
  int target = ordinal;
  for (int i = 0; i < kMostSeeks && target > 0; ++i, target = key_before(*table_, target)) {
    const std::optional<int64_t> time = seek_time((*table_)[target]);
    if (!time || !demuxer_.seek(*time) || !demuxer_.next(*packet_)) return false;
    const std::optional<int> landed = table_->ordinal_of(*packet_);
    if (!landed) return false;
    if (*landed > ordinal) continue;
    met_ = *landed;
    held_ = true;
    sought_ = true;
    return true;
  }
  return false;
}

Result<void> PacketReader::go_to(int ordinal) {
  wanted_ = ordinal;
  if (ordinal > 0 && seek_before(ordinal)) return {};
  return reopen();
}

Result<std::optional<int>> PacketReader::next(AVPacket& packet) {
  while (wanted_ < table_->size()) {
    if (!held_) {
      const bool more = demuxer_.next(*packet_);
      if (!more && !sought_) break;
      ++met_;
      if (sought_ && (!more || met_ >= table_->size() || !table_->matches(met_, *packet_))) {
        if (const Result<void> opened = reopen(); !opened) return fail(opened.error());
        continue;
      }
    }
    held_ = false;
    if (met_ < wanted_) continue;
    av_packet_unref(&packet);
    av_packet_move_ref(&packet, packet_.get());
    return wanted_++;
  }
  return std::optional<int>();
}

}  // namespace sigs::libav
