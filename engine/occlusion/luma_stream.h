// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <thread>

#include "base/bounded_queue.h"
#include "base/result.h"
#include "video/frame_source.h"

namespace sigs {

// Which frames of the footage: first, first + every, ..., count of them.
struct FrameSteps {
  int first = 0;
  int every = 1;
  int count = 0;

  [[nodiscard]] int at(int i) const { return first + i * every; }
};

struct LumaFrame {
  int number = 0;
  cv::Mat luma;  // CV_8UC1
  bool damaged = false;
};

// The luma of frames in order, decoded on a thread of its own some frames ahead of the caller. The footage may be used
// by nobody else meanwhile.
class LumaStream {
 public:
  LumaStream(FrameSource& footage, const FrameSteps& steps);
  ~LumaStream();
  LumaStream(const LumaStream&) = delete;
  LumaStream& operator=(const LumaStream&) = delete;

  // Nothing after the last one, or after an error.
  [[nodiscard]] std::optional<Result<LumaFrame>> next();

 private:
  void decode(FrameSource& footage, const FrameSteps& steps);
  void give_up(const Error& error);

  BoundedQueue<Result<LumaFrame>> ahead_;
  std::optional<Error> failure_;  // the thread's, until the queue is closed; then the caller's
  std::thread thread_;
};

}  // namespace sigs
