// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "base/bounded_queue.h"

namespace sigs {

// Takes numbered items in any order and gives them out by number. put() waits while its number is `ahead` or more
// beyond the next one due, so memory stays bounded; the next one due never waits.
template <class T>
class ReorderBuffer {
 public:
  ReorderBuffer(int first, int ahead) : next_(first), ahead_(ahead) {}

  bool put(int number, T item) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return number < next_ + ahead_ || closed_; });
    if (closed_) return false;
    items_.emplace(number, std::move(item));
    changed_.notify_all();
    return true;
  }

  // The next item by number; waits for it. Nothing once closed.
  std::optional<T> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return items_.contains(next_) || closed_; });
    if (closed_) return std::nullopt;
    auto node = items_.extract(next_);
    ++next_;
    changed_.notify_all();
    return std::move(node.mapped());
  }

  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, T> items_;
  int next_;
  int ahead_;
  bool closed_ = false;
};

}  // namespace sigs
