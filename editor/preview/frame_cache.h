// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace sigs::editor {

// A frame of one state of what it is made from: of a project, or of a footage.
struct FrameKey {
  std::uint64_t state = 0;
  int frame = 0;

  [[nodiscard]] auto operator<=>(const FrameKey&) const = default;
};

// Which frames are kept within a limit of bytes, and which goes first: those of other states than the present one
// before those of it, then what is farthest from the playhead, then the older state. Knows nothing of the frames
// themselves.
class CacheOrder {
 public:
  explicit CacheOrder(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

  void set_playhead(FrameKey playhead) { playhead_ = playhead; }

  // Another limit; names those that must go.
  [[nodiscard]] std::vector<FrameKey> set_limit(std::size_t limit_bytes);

  // Whether a frame of that size would be kept when it came: there is room, or what is worth less makes room.
  [[nodiscard]] bool would_keep(FrameKey key, std::size_t bytes) const;

  // Enters a frame, in place of what had the key, and names those that must go; it may be among them.
  [[nodiscard]] std::vector<FrameKey> put(FrameKey key, std::size_t bytes);

  [[nodiscard]] std::vector<int> frames_of(std::uint64_t state) const;
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  [[nodiscard]] std::vector<FrameKey> shrink();
  [[nodiscard]] bool is_worth_less(FrameKey a, FrameKey b) const;
  [[nodiscard]] std::optional<FrameKey> first_to_go() const;
  [[nodiscard]] std::size_t bytes_worth_less(FrameKey key, std::size_t enough) const;

  std::size_t limit_bytes_;
  std::size_t bytes_ = 0;
  FrameKey playhead_;
  std::map<FrameKey, std::size_t> bytes_of_;
};

// Frames by state and number in bounded memory. What was handed out lives on with whoever holds it. For one thread.
template <class Value>
class FrameCache {
 public:
  explicit FrameCache(std::size_t limit_bytes) : order_(limit_bytes) {}

  void set_playhead(FrameKey playhead) { order_.set_playhead(playhead); }

  // What no longer fits goes at once.
  void set_limit(std::size_t limit_bytes) {
    for (const FrameKey& gone : order_.set_limit(limit_bytes)) values_.erase(gone);
  }

  // Null where it is not there.
  [[nodiscard]] std::shared_ptr<const Value> find(FrameKey key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? nullptr : found->second;
  }

  [[nodiscard]] bool would_keep(FrameKey key, std::size_t bytes) const { return order_.would_keep(key, bytes); }

  void put(FrameKey key, std::shared_ptr<const Value> value, std::size_t bytes) {
    values_[key] = std::move(value);
    for (const FrameKey& gone : order_.put(key, bytes)) values_.erase(gone);
  }

  // In order.
  [[nodiscard]] std::vector<int> frames_of(std::uint64_t state) const { return order_.frames_of(state); }
  [[nodiscard]] std::size_t bytes() const { return order_.bytes(); }

 private:
  CacheOrder order_;
  std::map<FrameKey, std::shared_ptr<const Value>> values_;
};

}  // namespace sigs::editor
