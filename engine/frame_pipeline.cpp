// SPDX-License-Identifier: MIT
#include "frame_pipeline.h"

#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "outlook.h"

namespace sigs {

namespace {

bool any_in_view(const Scene& scene, int frame) {
  const OutlookPoints points(scene);
  for (int i = 0; i < static_cast<int>(scene.intruders.size()); ++i)
    if (points.at(i, frame).sighting != Sighting::out_of_view) return true;
  return false;
}

}  // namespace

FramePipeline::FramePipeline(const Scene& scene, FrameSource& source, const FrameRange& range, int jobs)
    : scene_(scene), source_(source), range_(range), decoded_(2), finished_(range.first, 2 * jobs + 2) {
  threads_.emplace_back([this] { decode(); });
  for (int i = 0; i < jobs; ++i) threads_.emplace_back([this] { compose(); });
}

FramePipeline::~FramePipeline() {
  decoded_.close();
  finished_.close();
  for (std::thread& thread : threads_) thread.join();
}

std::string FramePipeline::drawn_with() {
  const std::lock_guard lock(mutex_);
  return drawn_with_;
}

void FramePipeline::decode() {
  for (int number = range_.first; number <= range_.last; ++number) {
    const Stopwatch watch;
    Result<Frame> frame = source_.read(number);
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
  Bench bench;
  // Where the first frame needs OpenGL it is made while that is decoded. If it fails, the frame tells why.
  if (any_in_view(scene_, range_.first)) static_cast<void>(bench.renderer());
  while (std::optional<DecodedFrame> decoded = decoded_.take()) {
    Result<ComposedFrame> composed = compose_frame(scene_, decoded->number, std::move(decoded->picture), bench);
    if (composed && composed->work.pixels_drawn > 0) remember(bench.renderer_description());
    if (!finished_.put(decoded->number, std::move(composed))) break;
  }
}

void FramePipeline::remember(std::string description) {
  const std::lock_guard lock(mutex_);
  if (!description.empty()) drawn_with_ = std::move(description);
}

}  // namespace sigs
