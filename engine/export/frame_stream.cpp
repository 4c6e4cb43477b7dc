// SPDX-License-Identifier: MIT
#include "export/frame_stream.h"

#include <algorithm>
#include <utility>

#include "base/threads.h"
#include "export/frame_pipeline.h"
#include "scene/opened_project.h"

namespace sigs {

struct FrameStream::Inside {
  OpenedProject opened;
  FrameRange range;
  FootageTruth footage;
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
  return FrameStream(std::make_unique<Inside>(std::move(*opened), *range, std::move(footage)));
}

const FootageTruth& FrameStream::footage() const {
  return inside_->footage;
}

const std::vector<Warning>& FrameStream::warnings() const {
  return inside_->opened.warnings;
}

Result<int> FrameStream::show(int jobs, const std::function<Result<void>(const StreamFrame&)>& see) {
  const FrameRange range = inside_->range;
  FramePipeline pipeline(inside_->opened.scene, inside_->opened.source, range, std::max(1, jobs));
  int damaged = 0;
  for (int number = range.first; number <= range.last; ++number) {
    Result<ComposedFrame> frame = pipeline.next();
    if (!frame) return fail(frame.error());
    damaged += frame->image.damaged ? 1 : 0;
    const StreamFrame seen{.image = bgr_of(frame->image), .truth = std::move(frame->truth)};
    if (const Result<void> step = see(seen); !step) return fail(step.error());
  }
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
