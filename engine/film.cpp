// SPDX-License-Identifier: MIT
#include "film.h"

#include <algorithm>
#include <utility>

#include "base/guarded.h"
#include "frame_pipeline.h"
#include "opened_project.h"

namespace sigs {

struct Film::Inside {
  OpenedProject opened;
  FrameRange range;
  FootageTruth footage;
};

Film::Film(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;
Film::~Film() = default;

Result<Film> Film::open(const Project& project, const std::optional<FrameRange>& frames,
                        const std::atomic<bool>* cancel) {
  Result<OpenedProject> opened = guarded([&] { return open_project(project, cancel); });
  if (!opened) return fail(opened.error());
  const Result<FrameRange> range = range_in(opened->scene, frames);
  if (!range) return fail(range.error());
  FootageTruth footage = footage_truth(opened->source.info(), *range);
  return Film(std::make_unique<Inside>(std::move(*opened), *range, std::move(footage)));
}

const FootageTruth& Film::footage() const {
  return inside_->footage;
}

const std::vector<Warning>& Film::warnings() const {
  return inside_->opened.warnings;
}

Result<int> Film::show(int jobs, const std::function<Result<void>(const FilmFrame&)>& see) {
  const FrameRange range = inside_->range;
  FramePipeline pipeline(inside_->opened.scene, inside_->opened.source, range, std::max(1, jobs));
  int damaged = 0;
  for (int number = range.first; number <= range.last; ++number) {
    Result<ComposedFrame> frame = pipeline.next();
    if (!frame) return fail(frame.error());
    damaged += frame->picture.damaged ? 1 : 0;
    const FilmFrame seen{.picture = bgr_of(frame->picture), .truth = std::move(frame->truth)};
    if (const Result<void> step = see(seen); !step) return fail(step.error());
  }
  return damaged;
}

}  // namespace sigs
