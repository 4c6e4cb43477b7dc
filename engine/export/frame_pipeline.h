// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/bounded_queue.h"
#include "frame/compose_frame.h"
#include "project/project.h"
#include "scene/scene.h"
#include "video/frame_source.h"

namespace sigs {

// Takes numbered items in any order and returns them by number. put() waits while its number is `ahead` or more
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

// Decoding and composing in parallel, and in parallel to the caller that takes the frames. They come out in order; the
// first error in order of frames is returned.
class FramePipeline {
 public:
  // Scene and source must outlive it; no other code may read the source. jobs, 1 or more: frames composed in parallel,
  // fewer where the system gives no more threads.
  FramePipeline(const Scene& scene, FrameSource& source, const FrameRange& range, int jobs);
  ~FramePipeline();

  FramePipeline(const FramePipeline&) = delete;
  FramePipeline& operator=(const FramePipeline&) = delete;

  // The next frame of the range; waits for it. Not to be called after the last one or an error. Errors: those of the
  // frame; unavailable (no threads, no memory).
  [[nodiscard]] Result<ComposedFrame> next();

  [[nodiscard]] double decode_s() const { return decode_s_; }

  // What Renderer::description says; empty: nothing was drawn so far.
  [[nodiscard]] std::string renderer_description();

 private:
  struct DecodedFrame {
    int number = 0;
    Frame image;
  };
  void start(void (FramePipeline::*work)());
  void give_up(const Error& error);
  void decode();
  void compose();
  void remember(std::string description);

  const Scene& scene_;
  FrameSource& source_;
  FrameRange range_;
  BoundedQueue<DecodedFrame> decoded_;
  ReorderBuffer<Result<ComposedFrame>> finished_;
  std::atomic<double> decode_s_{0};
  std::mutex mutex_;
  std::string renderer_description_;
  std::optional<Error> failure_;  // of a thread as a whole
  std::vector<std::thread> threads_;
};

}  // namespace sigs
