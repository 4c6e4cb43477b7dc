// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/threads.h"
#include "frame/compose_frame.h"
#include "frame/composed_frame.h"
#include "project/project.h"
#include "scene/scene.h"
#include "truth/annotation.h"
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
  //   needed  by number from the first of the range: frames that are not are not decoded and have a truth without an
  //           image; each of them has truth_without_image(). Empty: all are needed
  FramePipeline(const Scene& scene, FrameSource& source, const FrameRange& range, int jobs,
                std::vector<bool> needed = {});
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
  void give_up(Error error);
  [[nodiscard]] bool is_needed(int number) const;
  void decode();
  [[nodiscard]] Result<ComposedFrame> composed(DecodedFrame decoded, ComposeContext& context) const;
  void compose();

  const Scene& scene_;
  FrameSource& source_;
  FrameRange range_;
  std::vector<bool> needed_;
  BoundedQueue<DecodedFrame> decoded_;
  ReorderBuffer<Result<ComposedFrame>> finished_;
  std::atomic<double> decode_s_{0};
  std::mutex mutex_;
  std::string renderer_description_;
  std::optional<Error> failure_;  // of a thread as a whole
  std::vector<std::thread> threads_;
};

// One composed frame for callers that process it rather than write it.
struct StreamFrame {
  cv::Mat image;  // CV_8UC3, BGR
  FrameTruth truth;
};

// The frames that an export of a project would write, in order, without writing them.
class FrameStream {
 public:
  // Checks the project and opens what it names. frames: none: the project's own range; numbers are the footage's.
  //   cancel  set: opening and composing end soon with the error interrupted; null, or outlives the stream
  // Errors as export_project's.
  [[nodiscard]] static Result<FrameStream> open(const Project& project, const std::optional<FrameRange>& frames = {},
                                                const std::atomic<bool>* cancel = nullptr);
  FrameStream(FrameStream&&) noexcept;
  FrameStream& operator=(FrameStream&&) noexcept;
  ~FrameStream();

  // The frames, and the footage's properties as in a label file of that export.
  [[nodiscard]] const FrameRange& range() const;
  [[nodiscard]] const FootageTruth& footage() const;
  [[nodiscard]] const std::vector<Warning>& warnings() const;

  // Begins to compose `jobs` frames in parallel, from the first one on, some frames ahead of next(). To be called
  // before next(); not together with show().
  void start(int jobs);

  // The next frame, in the footage's planes, with mask and truth; waits for it. None after the last one, which also
  // ends the threads. Not to be called after an error.
  [[nodiscard]] Result<std::optional<ComposedFrame>> next();

  // Composes `jobs` frames in parallel and passes each to `see`, on the calling thread. Ends early where that returns
  // an error, and returns it. Returns how many frames of the footage were damaged.
  [[nodiscard]] Result<int> show(int jobs, const std::function<Result<void>(const StreamFrame&)>& see);

 private:
  struct Inside;
  explicit FrameStream(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

// The footage's properties in the labels of these frames.
[[nodiscard]] FootageTruth footage_truth(const VideoInfo& footage, const FrameRange& range);

}  // namespace sigs
