// SPDX-License-Identifier: MIT
#include "editor/preview/frame_cache.h"

#include <cstdlib>

namespace sigs::editor {

namespace {

long long distance(FrameKey a, FrameKey b) {
  return std::llabs(static_cast<long long>(a.frame) - b.frame);
}

}  // namespace

std::size_t CacheOrder::bytes_of(FrameKey key) const {
  const auto frames = frames_.find(key.content);
  if (frames == frames_.end()) return 0;
  const auto found = frames->second.bytes_by_number.find(key.frame);
  return found == frames->second.bytes_by_number.end() ? 0 : found->second;
}

// One that is not there yet would be the newest.
std::uint64_t CacheOrder::age_of(const ContentId& content) const {
  const auto frames = frames_.find(content);
  return frames == frames_.end() ? contents_counted_ + 1 : frames->second.age;
}

bool CacheOrder::is_worth_less(FrameKey a, FrameKey b) const {
  const bool a_is_present = a.content == playhead_.content;
  const bool b_is_present = b.content == playhead_.content;
  if (a_is_present != b_is_present) return b_is_present;
  const long long a_away = distance(a, playhead_);
  const long long b_away = distance(b, playhead_);
  if (a_away != b_away) return a_away > b_away;
  return a.content == b.content ? a.frame < b.frame : age_of(a.content) < age_of(b.content);
}

// Frames lie in order, so the farthest of a content is its first or its last.
std::optional<FrameKey> CacheOrder::first_to_go() const {
  std::optional<FrameKey> first_to_go;
  const auto consider = [&](FrameKey key) {
    if (!first_to_go || is_worth_less(key, *first_to_go)) first_to_go = key;
  };
  for (const auto& [content, frames] : frames_) {
    consider({content, frames.bytes_by_number.begin()->first});
    consider({content, frames.bytes_by_number.rbegin()->first});
  }
  return first_to_go;
}

std::size_t CacheOrder::bytes_worth_less(FrameKey key, std::size_t enough) const {
  std::size_t sum = 0;
  for (const auto& [content, frames] : frames_)
    for (const auto& [number, bytes] : frames.bytes_by_number) {
      if (sum >= enough) return sum;
      const FrameKey other{content, number};
      if (other != key && is_worth_less(other, key)) sum += bytes;
    }
  return sum;
}

bool CacheOrder::would_keep(FrameKey key, std::size_t bytes) const {
  if (bytes > limit_bytes_) return false;
  const std::size_t others = bytes_ - bytes_of(key);
  if (others + bytes <= limit_bytes_) return true;
  const std::size_t needed = others + bytes - limit_bytes_;
  return bytes_worth_less(key, needed) >= needed;
}

std::vector<FrameKey> CacheOrder::put(FrameKey key, std::size_t bytes) {
  Frames& frames = frames_[key.content];
  if (frames.bytes_by_number.empty()) frames.age = ++contents_counted_;
  std::size_t& known = frames.bytes_by_number[key.frame];
  bytes_ += bytes - known;
  known = bytes;
  return shrink();
}

void CacheOrder::remove(FrameKey key) {
  const auto frames = frames_.find(key.content);
  bytes_ -= bytes_of(key);
  frames->second.bytes_by_number.erase(key.frame);
  if (frames->second.bytes_by_number.empty()) frames_.erase(frames);
}

std::vector<FrameKey> CacheOrder::set_limit(std::size_t limit_bytes) {
  limit_bytes_ = limit_bytes;
  return shrink();
}

std::vector<FrameKey> CacheOrder::shrink() {
  std::vector<FrameKey> gone;
  while (bytes_ > limit_bytes_) {
    gone.push_back(*first_to_go());
    remove(gone.back());
  }
  return gone;
}

std::vector<int> CacheOrder::frames_of(const ContentId& content) const {
  std::vector<int> numbers;
  if (const auto frames = frames_.find(content); frames != frames_.end())
    for (const auto& [number, bytes] : frames->second.bytes_by_number) numbers.push_back(number);
  return numbers;
}

}  // namespace sigs::editor
