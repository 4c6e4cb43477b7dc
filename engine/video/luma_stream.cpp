// SPDX-License-Identifier: MIT
#include "video/luma_stream.h"

#include <utility>

#include "base/threads.h"
#include "video/bit_depth.h"

namespace sigs {

namespace {

// ITU-R BT.709: 0.2126, 0.7152, 0.0722. They add up to 256, so grey keeps its code.
constexpr int kRed = 54;
constexpr int kGreen = 183;
constexpr int kBlue = 19;
static_assert(kRed + kGreen + kBlue == 256);

constexpr std::size_t kFramesAhead = 8;  // enough for a method that collects some frames and processes them together

}  // namespace

cv::Mat luma_of(const Frame& footage) {
  Frame frame = footage;
  if (frame.layout != PixelLayout::rgb) {
    frame.layout = PixelLayout::gray;  // only luma is rounded
    return with_bit_depth(frame, 8).planes[0];
  }
  frame = with_bit_depth(frame, 8);
  cv::Mat luma(frame.size_px(), CV_8UC1);
  for (int y = 0; y < luma.rows; ++y) {
    const uchar* const red = frame.planes[0].ptr<uchar>(y);
    const uchar* const green = frame.planes[1].ptr<uchar>(y);
    const uchar* const blue = frame.planes[2].ptr<uchar>(y);
    uchar* const out = luma.ptr<uchar>(y);
    for (int x = 0; x < luma.cols; ++x)
      out[x] = static_cast<uchar>((kRed * red[x] + kGreen * green[x] + kBlue * blue[x] + 128) >> 8);
  }
  return luma;
}

LumaStream::LumaStream(FrameSource& footage, const FrameSteps& steps) : ahead_(kFramesAhead) {
  Result<std::thread> thread = started_thread([this, &footage, steps] { decode(footage, steps); },
                                              [this](const Error& error) { give_up(error); });
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
