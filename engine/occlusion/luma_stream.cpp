// SPDX-License-Identifier: MIT
#include "occlusion/luma_stream.h"

#include <utility>

#include "base/threads.h"
#include "occlusion/luma.h"

namespace sigs {

namespace {

// Enough for a method that keeps some frames and works them off together.
constexpr std::size_t kFramesAhead = 8;

}  // namespace

LumaStream::LumaStream(FrameSource& footage, const FrameSteps& steps) : ahead_(kFramesAhead) {
  Result<std::thread> thread = started_thread([this, &footage, steps] {
    const Result<void> done = guarded([&]() -> Result<void> {
      decode(footage, steps);
      return {};
    });
    if (!done) give_up(done.error());
  });
  if (thread)
    thread_ = std::move(*thread);
  else
    give_up(thread.error());
}

LumaStream::~LumaStream() {
  ahead_.close();
  if (thread_.joinable()) thread_.join();
}

void LumaStream::give_up(const Error& error) {
  failure_ = error;
  ahead_.close();
}

std::optional<Result<LumaFrame>> LumaStream::next() {
  std::optional<Result<LumaFrame>> frame = ahead_.take();
  if (frame || !failure_) return frame;
  return fail(*std::exchange(failure_, std::nullopt));
}

void LumaStream::decode(FrameSource& footage, const FrameSteps& steps) {
  for (int i = 0; i < steps.count; ++i) {
    const Result<Frame> frame = footage.read(steps.at(i));
    const bool wanted =
        frame ? ahead_.put(LumaFrame{steps.at(i), luma_of(*frame), frame->damaged}) : ahead_.put(fail(frame.error()));
    if (!wanted || !frame) break;
  }
  ahead_.close();
}

}  // namespace sigs
