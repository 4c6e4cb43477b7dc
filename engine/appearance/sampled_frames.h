// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <thread>
#include <vector>

#include "base/bounded_queue.h"
#include "base/result.h"
#include "video/frame.h"
#include "video/frame_source.h"

namespace sigs {

struct NumberedFrame {
  int number = 0;  // of the frame in the footage
  Frame frame;
};

// Decodes the frames of these numbers on a thread of its own, up to 4 ahead of the caller, and gives them in order,
// with 8 bits: deeper samples are rounded. No other code may use the footage while the stream exists.
class SampledFrames {
 public:
  SampledFrames(FrameSource& footage, std::vector<int> numbers);
  ~SampledFrames();
  SampledFrames(const SampledFrames&) = delete;
  SampledFrames& operator=(const SampledFrames&) = delete;

  // The next frame, or the error that ended the decoding; nothing after the last frame or after an error.
  [[nodiscard]] std::optional<Result<NumberedFrame>> next();

 private:
  void decode(FrameSource& footage, const std::vector<int>& numbers);
  void give_up(const Error& error);

  BoundedQueue<Result<NumberedFrame>> ahead_;
  std::optional<Error> failure_;  // written by the thread until the queue is closed, then read by the caller
  std::thread thread_;
};

}  // namespace sigs
