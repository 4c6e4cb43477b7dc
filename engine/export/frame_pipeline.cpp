// SPDX-License-Identifier: MIT
#include "export/frame_pipeline.h"

#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "base/threads.h"
#include "scene/visibility.h"

namespace sigs {

FramePipeline::FramePipeline(const Scene& scene, FrameSource& source, const FrameRange& range, int jobs)
    : scene_(scene), source_(source), range_(range), decoded_(2), finished_(range.first, 2 * jobs + 2) {
  threads_.reserve(static_cast<std::size_t>(jobs) + 1);
  start(&FramePipeline::decode);
  if (!threads_.empty())
    for (int i = 0; i < jobs; ++i) start(&FramePipeline::compose);
}

// Fewer composing threads than requested do the same work, more slowly; without any it ends in an error.
void FramePipeline::start(void (FramePipeline::*work)()) {
  Result<std::thread> thread =
      started_thread([this, work] { (this->*work)(); }, [this](const Error& error) { give_up(error); });
  if (thread)
    threads_.push_back(std::move(*thread));
  else if (threads_.size() < 2)
    give_up(thread.error());
}

void FramePipeline::give_up(const Error& error) {
  {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = error;
  }
  decoded_.close();
  finished_.close();
}

Result<ComposedFrame> FramePipeline::next() {
  if (std::optional<Result<ComposedFrame>> frame = finished_.take()) return std::move(*frame);
  const std::lock_guard lock(mutex_);
  return fail(*failure_);  // only a failure closes it before the end
}

FramePipeline::~FramePipeline() {
  decoded_.close();
  finished_.close();
  for (std::thread& thread : threads_) thread.join();
}

std::string FramePipeline::renderer_description() {
  const std::lock_guard lock(mutex_);
  return renderer_description_;
}

void FramePipeline::decode() {
  for (int number = range_.first; number <= range_.last; ++number) {
    const Stopwatch watch;
    Result<Frame> frame = guarded([&] { return source_.read(number); });
    decode_s_ = decode_s_ + watch.elapsed_s();
    if (!frame) {
      finished_.put(number, fail(frame.error()));
      break;
    }
    if (!decoded_.put({number, std::move(*frame)})) break;
  }
  decoded_.close();
}

void FramePipeline::compose() {
  ComposeContext context;
  // Where the first frame needs OpenGL it is made while that is decoded. If it fails, the frame's error gives the
  // reason.
  if (any_in_view(scene_, range_.first)) static_cast<void>(context.renderer());
  while (std::optional<DecodedFrame> decoded = decoded_.take()) {
    Result<ComposedFrame> composed =
        guarded([&] { return compose_frame(scene_, decoded->number, std::move(decoded->image), context); });
    if (composed && composed->op_counts.pixels_drawn > 0) remember(context.renderer_description());
    if (!finished_.put(decoded->number, std::move(composed))) break;
  }
}

void FramePipeline::remember(std::string description) {
  const std::lock_guard lock(mutex_);
  if (!description.empty()) renderer_description_ = std::move(description);
}

}  // namespace sigs
