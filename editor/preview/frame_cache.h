// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "editor/document/content_id.h"

namespace sigs::editor {

// A frame of one content: of a project with its files (combined_id), or of a footage (FootageId).
struct FrameKey {
  ContentId content;
  int frame = 0;

  [[nodiscard]] auto operator<=>(const FrameKey&) const = default;
};

// Decides which frames are kept within a limit of bytes. First to go are frames of another content than the playhead's,
// then those that are farthest from the playhead, then those whose content came earlier, then those with the lower
// number. Knows keys and sizes alone, so that it can be tested without images. For one thread at a time.
class CacheOrder {
 public:
  explicit CacheOrder(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

  // The frame that is wanted, and its content. Nothing goes by this call alone.
  void set_playhead(FrameKey playhead) { playhead_ = playhead; }

  // Sets another limit and names the frames that must go; they are removed already.
  [[nodiscard]] std::vector<FrameKey> set_limit(std::size_t limit_bytes);

  // Whether a frame of that size would be kept when it came: there is room, or frames that are worth less make room.
  // Asked before a frame is made ahead, so that no work is done for nothing.
  [[nodiscard]] bool would_keep(FrameKey key, std::size_t bytes) const;

  // Enters a frame, in place of what had the key, and names those that must go; they are removed already. The frame
  // itself may be among them.
  [[nodiscard]] std::vector<FrameKey> put(FrameKey key, std::size_t bytes);

  // Numbers of the frames that are kept of a content, ascending.
  [[nodiscard]] std::vector<int> frames_of(const ContentId& content) const;
  // Of all frames that are kept; never above the limit.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Frames {
    std::uint64_t age = 0;  // contents are counted as they come; one that has gone altogether is counted anew
    std::map<int, std::size_t> bytes_by_number;
  };

  [[nodiscard]] std::vector<FrameKey> shrink();  // removes frames until the limit holds, and names them
  [[nodiscard]] bool is_worth_less(FrameKey a, FrameKey b) const;  // whether a goes before b
  [[nodiscard]] std::optional<FrameKey> first_to_go() const;
  // Of the frames that would go before `key`. The sum stops as soon as it is `enough`.
  [[nodiscard]] std::size_t bytes_worth_less(FrameKey key, std::size_t enough) const;
  [[nodiscard]] std::size_t bytes_of(FrameKey key) const;  // 0: it is not there
  [[nodiscard]] std::uint64_t age_of(const ContentId& content) const;
  void remove(FrameKey key);

  std::size_t limit_bytes_;
  std::size_t bytes_ = 0;
  FrameKey playhead_;
  std::uint64_t contents_counted_ = 0;
  std::map<ContentId, Frames> frames_;
};

// Frames by content and number within a limit of bytes. What find() returned lives on with whoever holds it, though it
// has left the cache and no longer counts. For one thread at a time: PreviewState holds its lock.
template <class Value>
class FrameCache : private CacheOrder {
 public:
  using CacheOrder::bytes;
  using CacheOrder::CacheOrder;
  using CacheOrder::frames_of;
  using CacheOrder::set_playhead;
  using CacheOrder::would_keep;

  // What no longer fits goes at once.
  void set_limit(std::size_t limit_bytes) { drop(CacheOrder::set_limit(limit_bytes)); }

  // Null where it is not there.
  [[nodiscard]] std::shared_ptr<const Value> find(FrameKey key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? nullptr : found->second;
  }

  // bytes: what the value counts, as its owner measures it. A value that is worth less than those that are there does
  // not stay; find() is null then.
  void put(FrameKey key, std::shared_ptr<const Value> value, std::size_t bytes) {
    values_[key] = std::move(value);
    drop(CacheOrder::put(key, bytes));
  }

 private:
  void drop(const std::vector<FrameKey>& gone) {
    for (const FrameKey& key : gone) values_.erase(key);
  }

  std::map<FrameKey, std::shared_ptr<const Value>> values_;
};

}  // namespace sigs::editor
