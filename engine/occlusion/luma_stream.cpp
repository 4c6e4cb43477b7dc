// SPDX-License-Identifier: MIT
#include "occlusion/luma_stream.h"

#include <utility>

#include "occlusion/luma.h"

namespace sigs {

namespace {

// Enough for a method that keeps some frames and works them off together.
constexpr std::size_t kFramesAhead = 8;

}  // namespace

LumaStream::LumaStream(FrameSource& footage, const FrameSteps& steps)
    : ahead_(kFramesAhead), thread_([this, &footage, steps] { decode(footage, steps); }) {}

LumaStream::~LumaStream() {
  ahead_.close();
  thread_.join();
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
