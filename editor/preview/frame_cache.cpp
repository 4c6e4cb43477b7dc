// SPDX-License-Identifier: MIT
#include "editor/preview/frame_cache.h"

#include <cstdlib>
#include <iterator>
#include <limits>

namespace sigs::editor {

namespace {

constexpr int kFirstFrame = std::numeric_limits<int>::min();

long long distance(FrameKey a, FrameKey b) {
  return std::llabs(static_cast<long long>(a.frame) - b.frame);
}

}  // namespace

bool CacheOrder::is_worth_less(FrameKey a, FrameKey b) const {
  const bool a_is_present = a.state == playhead_.state;
  const bool b_is_present = b.state == playhead_.state;
  if (a_is_present != b_is_present) return b_is_present;
  const long long a_away = distance(a, playhead_);
  const long long b_away = distance(b, playhead_);
  return a_away != b_away ? a_away > b_away : a < b;
}

// Frames lie in order, so the farthest of a state is its first or its last.
std::optional<FrameKey> CacheOrder::first_to_go() const {
  std::optional<FrameKey> first_to_go;
  const auto consider = [&](FrameKey key) {
    if (!first_to_go || is_worth_less(key, *first_to_go)) first_to_go = key;
  };
  for (auto at = bytes_of_.begin(); at != bytes_of_.end();) {
    const std::uint64_t state = at->first.state;
    const auto next = bytes_of_.lower_bound({state + 1, kFirstFrame});
    consider(at->first);
    consider(std::prev(next)->first);
    at = next;
  }
  return first_to_go;
}

std::size_t CacheOrder::bytes_worth_less(FrameKey key, std::size_t enough) const {
  std::size_t sum = 0;
  for (const auto& [other, bytes] : bytes_of_) {
    if (sum >= enough) break;
    if (other != key && is_worth_less(other, key)) sum += bytes;
  }
  return sum;
}

bool CacheOrder::would_keep(FrameKey key, std::size_t bytes) const {
  if (bytes > limit_bytes_) return false;
  const auto known = bytes_of_.find(key);
  const std::size_t others = bytes_ - (known == bytes_of_.end() ? 0 : known->second);
  if (others + bytes <= limit_bytes_) return true;
  const std::size_t needed = others + bytes - limit_bytes_;
  return bytes_worth_less(key, needed) >= needed;
}

std::vector<FrameKey> CacheOrder::put(FrameKey key, std::size_t bytes) {
  std::size_t& known = bytes_of_[key];
  bytes_ += bytes - known;
  known = bytes;
  return shrink();
}

std::vector<FrameKey> CacheOrder::set_limit(std::size_t limit_bytes) {
  limit_bytes_ = limit_bytes;
  return shrink();
}

std::vector<FrameKey> CacheOrder::shrink() {
  std::vector<FrameKey> gone;
  while (bytes_ > limit_bytes_) {
    const FrameKey first_to_go = *this->first_to_go();
    bytes_ -= bytes_of_[first_to_go];
    bytes_of_.erase(first_to_go);
    gone.push_back(first_to_go);
  }
  return gone;
}

std::vector<int> CacheOrder::frames_of(std::uint64_t state) const {
  std::vector<int> frames;
  const auto end = bytes_of_.upper_bound({state, std::numeric_limits<int>::max()});
  for (auto at = bytes_of_.lower_bound({state, kFirstFrame}); at != end; ++at) frames.push_back(at->first.frame);
  return frames;
}

}  // namespace sigs::editor
