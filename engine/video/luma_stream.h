// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <thread>

#include "base/bounded_queue.h"
#include "base/result.h"
#include "video/frame.h"
#include "video/frame_source.h"

namespace sigs {

// The luma of a frame, CV_8UC1, that of more bits rounded (with_bit_depth). Of footage with luma: plane 0 itself, whose
// samples are shared where it has 8 bits. Of RGB: the weighted sum of ITU-R BT.709, full range, with weights rounded to
// 1/256.
[[nodiscard]] cv::Mat luma_of(const Frame& frame);

// The frames of the footage that are used: first, first + every, ..., `count` of them.
struct FrameSteps {
  int first = 0;
  int every = 1;
  int count = 0;

  // Number of the i-th frame used, from 0.
  [[nodiscard]] int at(int i) const { return first + i * every; }
};

struct LumaFrame {
  int number = 0;        // of the frame in the footage
  cv::Mat luma;          // CV_8UC1
  bool damaged = false;  // as Frame::damaged
};

// Decodes frames on a thread of its own, up to 8 ahead of the caller, and gives their luma in order. No other code may
// use the footage while the stream exists.
class LumaStream {
 public:
  LumaStream(FrameSource& footage, const FrameSteps& steps);
  ~LumaStream();
  LumaStream(const LumaStream&) = delete;
  LumaStream& operator=(const LumaStream&) = delete;

  // The next frame, or the error that ended the decoding; nothing after the last frame or after an error.
  [[nodiscard]] std::optional<Result<LumaFrame>> next();

 private:
  void decode(FrameSource& footage, const FrameSteps& steps);
  void give_up(const Error& error);

  BoundedQueue<Result<LumaFrame>> ahead_;
  std::optional<Error> failure_;  // written by the thread until the queue is closed, then read by the caller
  std::thread thread_;
};

}  // namespace sigs
