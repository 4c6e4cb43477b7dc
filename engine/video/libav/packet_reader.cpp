// SPDX-License-Identifier: MIT
#include "video/libav/packet_reader.h"

#include <algorithm>

#include "base/ensure.h"

namespace sigs::libav {
namespace {

constexpr int kMaxSeeks = 5;
constexpr size_t kMaxRecent = 64;
constexpr size_t kMaxRecentBytes = 8 << 20;

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
  for (int i = 0; i < kMaxSeeks && target > 0; ++i, target = key_before(*table_, target)) {
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
  if (ordinal <= read_ && ordinal >= read_ - static_cast<int>(recent_.size())) return {};
  recent_.clear();
  recent_bytes_ = 0;
  read_ = ordinal;
  if (ordinal > 0 && seek_before(ordinal)) return {};
  return reopen();
}

Error PacketReader::changed() const {
  return {path_.string(), "changed while it was being read"};
}

// Packet read_ into packet_; false: the file ends before it.
Result<bool> PacketReader::read_on() {
  while (read_ < table_->size()) {
    if (!held_) {
      const bool more = demuxer_.next(*packet_);
      ++met_;
      if (!more || met_ >= table_->size() || !table_->looks_like(met_, *packet_)) {
        if (!sought_) return fail(changed());
        if (const Result<void> opened = reopen(); !opened) return fail(opened.error());
        continue;
      }
    }
    held_ = false;
    if (met_ >= read_) return true;
  }
  return false;
}

void PacketReader::keep() {
  PacketPtr kept = new_packet();
  recent_bytes_ += static_cast<size_t>(packet_->size);
  av_packet_move_ref(kept.get(), packet_.get());
  recent_.push_back(std::move(kept));
  ++read_;
  while (recent_.size() > 1 && (recent_.size() > kMaxRecent || recent_bytes_ > kMaxRecentBytes)) {
    recent_bytes_ -= static_cast<size_t>(recent_.front()->size);
    recent_.pop_front();
  }
}

Result<std::optional<int>> PacketReader::next(AVPacket& packet) {
  if (wanted_ == read_) {
    const Result<bool> more = read_on();
    if (!more) return fail(more.error());
    if (!*more) return std::optional<int>();
    keep();
  }
  av_packet_unref(&packet);
  const auto place = recent_.end() - (read_ - wanted_);
  ENSURE(av_packet_ref(&packet, place->get()) >= 0);
  return wanted_++;
}

}  // namespace sigs::libav
