// SPDX-License-Identifier: MIT
#include "export/frame_stream.h"

#include <algorithm>
#include <utility>

#include "base/ensure.h"
#include "base/stopwatch.h"
#include "export/export_files.h"
#include "scene/opened_project.h"
#include "scene/visibility.h"

namespace sigs {

FramePipeline::FramePipeline(const Scene& scene, FrameSource& source, const FrameRange& range, int jobs,
                             std::vector<bool> needed)
    : scene_(scene),
      source_(source),
      range_(range),
      needed_(std::move(needed)),
      decoded_(2),
      finished_(range.first, 2 * jobs + 2) {
  threads_.reserve(static_cast<std::size_t>(jobs) + 1);
  start(&FramePipeline::decode);
  if (!threads_.empty())
    for (int i = 0; i < jobs; ++i) start(&FramePipeline::compose);
}

// Fewer composing threads than requested do the same work, more slowly; without any it ends in an error.
void FramePipeline::start(void (FramePipeline::*work)()) {
  Result<std::thread> thread =
      started_thread([this, work] { (this->*work)(); }, [this](Error error) { give_up(std::move(error)); });
  if (thread)
    threads_.push_back(std::move(*thread));
  else if (threads_.size() < 2)
    give_up(std::move(thread.error()));
}

void FramePipeline::give_up(Error error) {
  {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(error);
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

bool FramePipeline::is_needed(int number) const {
  return needed_.empty() || needed_[static_cast<std::size_t>(number - range_.first)];
}

void FramePipeline::decode() {
  for (int number = range_.first; number <= range_.last; ++number) {
    if (!is_needed(number)) {
      if (!decoded_.put({number, {.time_s = source_.info().times_s[static_cast<std::size_t>(number)]}})) break;
      continue;
    }
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

Result<ComposedFrame> FramePipeline::composed(DecodedFrame decoded, ComposeContext& context) const {
  if (is_needed(decoded.number)) return compose_frame(scene_, decoded.number, std::move(decoded.image), context);
  Result<std::optional<FrameTruth>> truth =
      truth_without_image(scene_, decoded.number, source_.info().color, source_.info().bit_depth, context);
  if (!truth) return fail(truth.error());
  ENSURE(truth->has_value());
  ComposedFrame composed{.image = std::move(decoded.image)};
  composed.truth = **std::move(truth);
  return composed;
}

void FramePipeline::compose() {
  ComposeContext context;
  // Where the first frame needs OpenGL it is made while that is decoded. If it fails, the frame's error gives the
  // reason.
  if (any_in_view(scene_, range_.first)) static_cast<void>(context.renderer());
  while (std::optional<DecodedFrame> decoded = decoded_.take()) {
    const int number = decoded->number;
    Result<ComposedFrame> frame = guarded([&] { return composed(std::move(*decoded), context); });
    if (frame && frame->op_counts.pixels_drawn > 0)
      if (std::string description = context.renderer_description(); !description.empty()) {
        const std::lock_guard lock(mutex_);
        renderer_description_ = std::move(description);
      }
    if (!finished_.put(number, std::move(frame))) break;
  }
}

struct FrameStream::Inside {
  OpenedProject opened;
  FrameRange range;
  FootageTruth footage;
  std::optional<ExportedEncounters> encounters;  // none: the project asks for none
  std::unique_ptr<FramePipeline> pipeline;       // while frames are composed
  int next = 0;                                  // number of the frame that next() returns
};

FrameStream::FrameStream(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
FrameStream::FrameStream(FrameStream&&) noexcept = default;
FrameStream& FrameStream::operator=(FrameStream&&) noexcept = default;
FrameStream::~FrameStream() = default;

Result<FrameStream> FrameStream::open(const Project& project, const std::optional<FrameRange>& frames,
                                      const std::atomic<bool>* cancel) {
  Result<OpenedProject> opened = guarded([&] { return open_project(project, cancel); });
  if (!opened) return fail(opened.error());
  const Result<FrameRange> range = range_in(opened->scene, frames);
  if (!range) return fail(range.error());
  FootageTruth footage = footage_truth(opened->source.info(), *range);
  auto inside = std::make_unique<Inside>(Inside{std::move(*opened), *range, std::move(footage), {}, {}, range->first});
  if (!project.output.encounter.empty()) {
    Result<ExportedEncounters> encounters = ExportedEncounters::of(project, inside->opened.scene, *range);
    if (!encounters) return fail(encounters.error());
    inside->encounters = std::move(*encounters);
  }
  return FrameStream(std::move(inside));
}

const FrameRange& FrameStream::range() const {
  return inside_->range;
}

const FootageTruth& FrameStream::footage() const {
  return inside_->footage;
}

const std::vector<Warning>& FrameStream::warnings() const {
  return inside_->opened.warnings;
}

void FrameStream::start(int jobs) {
  inside_->pipeline.reset();
  inside_->next = inside_->range.first;
  inside_->pipeline =
      std::make_unique<FramePipeline>(inside_->opened.scene, inside_->opened.source, inside_->range, std::max(1, jobs));
}

Result<std::optional<ComposedFrame>> FrameStream::next() {
  if (inside_->next > inside_->range.last) {
    inside_->pipeline.reset();
    return std::nullopt;
  }
  ENSURE(inside_->pipeline);
  ++inside_->next;
  Result<ComposedFrame> frame = inside_->pipeline->next();
  if (!frame) return fail(frame.error());
  if (inside_->encounters) inside_->encounters->add_to(frame->truth);
  return std::optional<ComposedFrame>(std::move(*frame));
}

Result<int> FrameStream::show(int jobs, const std::function<Result<void>(const StreamFrame&)>& see) {
  start(jobs);
  const auto shown = [&]() -> Result<int> {
    int damaged = 0;
    while (true) {
      Result<std::optional<ComposedFrame>> frame = next();
      if (!frame) return fail(frame.error());
      if (!*frame) return damaged;
      damaged += (*frame)->image.damaged ? 1 : 0;
      const StreamFrame seen{.image = bgr_of((*frame)->image), .truth = std::move((*frame)->truth)};
      if (const Result<void> step = see(seen); !step) return fail(step.error());
    }
  };
  Result<int> damaged = shown();
  inside_->pipeline.reset();
  return damaged;
}

FootageTruth footage_truth(const VideoInfo& footage, const FrameRange& range) {
  return {.video = footage.path.filename().string(),
          .size_px = footage.size_px,
          .first_frame = range.first,
          .last_frame = range.last,
          .frame_rate_num = footage.frame_rate_num,
          .frame_rate_den = footage.frame_rate_den};
}

}  // namespace sigs
