// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "base/bounded_queue.h"
#include "base/result.h"
#include "video/video_writer.h"

namespace sigs {

// The error of one frame of an output.
struct FrameFailure {
  int frame = 0;
  Error error;
};

// A video that is encoded and written on a thread of its own, in parallel to the caller and the other outputs of an
// export. A thread that cannot be started is the failure of the first frame.
class WriterThread {
 public:
  explicit WriterThread(VideoWriter writer);
  ~WriterThread();  // discards queued and unfinished frames

  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  // Passes a frame to the thread; waits while some are queued already. The caller must not change its samples
  // afterwards. False: an earlier frame could not be written, join() says which.
  [[nodiscard]] bool put(Frame frame, int number);

  // A frame whose samples are all 0.
  [[nodiscard]] bool put_blank(double time_s, int number);

  // Waits until all frames passed to it are written; none can be passed after it. The frame that failed, if
  // any.
  [[nodiscard]] std::optional<FrameFailure> join();

  // Completes the file. Call it after join(), where that gave nothing.
  [[nodiscard]] Result<void> finish();

  // Seconds spent writing so far. Call it after join().
  [[nodiscard]] double spent_s() const { return spent_s_; }

 private:
  struct Item {
    Frame frame;
    int number = 0;
    bool is_blank = false;
  };
  void write_all();
  void give_up(const Error& error);

  VideoWriter writer_;
  BoundedQueue<Item> queue_{2};
  std::atomic<bool> dropped_{false};
  std::optional<FrameFailure> failure_;  // of the thread, until it is joined
  double spent_s_ = 0;                   // likewise
  int at_ = 0;                           // likewise: the frame that is written
  std::thread thread_;
};

}  // namespace sigs
