// SPDX-License-Identifier: MIT
#include "appearance/sampled_frames.h"

#include <utility>

#include "base/threads.h"
#include "video/bit_depth.h"

namespace sigs {

namespace {

constexpr std::size_t kDecodedAhead = 4;

}  // namespace

SampledFrames::SampledFrames(FrameSource& footage, std::vector<int> numbers) : ahead_(kDecodedAhead) {
  Result<std::thread> thread =
      started_thread([this, &footage, numbers = std::move(numbers)] { decode(footage, numbers); },
                     [this](const Error& error) { give_up(error); });
  if (thread)
    thread_ = std::move(*thread);
  else
    give_up(thread.error());
}

SampledFrames::~SampledFrames() {
  ahead_.close();
  if (thread_.joinable()) thread_.join();
}

void SampledFrames::give_up(const Error& error) {
  failure_ = error;
  ahead_.close();
}

std::optional<Result<NumberedFrame>> SampledFrames::next() {
  std::optional<Result<NumberedFrame>> frame = ahead_.take();
  if (frame || !failure_) return frame;
  return fail(*std::exchange(failure_, std::nullopt));
}

void SampledFrames::decode(FrameSource& footage, const std::vector<int>& numbers) {
  for (const int number : numbers) {
    Result<Frame> frame = footage.read(number);
    const bool is_read = frame.has_value();
    const bool is_wanted =
        is_read ? ahead_.put(NumberedFrame{number, with_bit_depth(*frame, 8)}) : ahead_.put(fail(frame.error()));
    if (!is_wanted || !is_read) break;
  }
  ahead_.close();
}

}  // namespace sigs
