// SPDX-License-Identifier: MIT
#include "editor/preview/truth_builder.h"

#include <algorithm>
#include <utility>

#include "base/threads.h"
#include "editor/preview/surveys.h"
#include "editor/preview/worker_thread.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kMaxKept = 16;
constexpr int kFramesAWord = 8;  // to the window

std::string why_not(const OpenedScene& scene) {
  if (scene.footage && !scene.footage->problem.empty()) return scene.footage->problem;
  if (!scene.draft.problems.empty()) return "the project has problems";
  return {};
}

// Composing may run out of OpenGL or memory.
Result<void> streamed(const TruthBuilder::StreamFrames& show, const Project& project,
                      const TruthBuilder::OnFrame& on_frame) {
  return guarded([&] { return show(project, 1, on_frame); }, "composing");
}

}  // namespace

Result<void> stream_frames(const Project& project, int jobs, const TruthBuilder::OnFrame& on_frame) {
  Result<FrameStream> stream = FrameStream::open(project);
  if (!stream) return fail(stream.error());
  const Result<int> damaged = stream->show(jobs, on_frame);
  if (!damaged) return fail(damaged.error());
  return {};
}

TruthBuilder::TruthBuilder(std::function<void()> wake, StreamFrames show, std::chrono::milliseconds idle_time)
    : wake_(std::move(wake)),
      stream_(std::move(show)),
      idle_time_(idle_time),
      worker_({.work = [this](const Scene& scene) { build(scene); }, .niceness = kBackgroundNiceness}) {}

TruthBuilder::~TruthBuilder() = default;

void TruthBuilder::want(std::shared_ptr<const OpenedScene> scene) {
  const std::lock_guard lock(mutex_);
  if (!scene) state_ = {};
  worker_.want(std::move(scene));
}

TruthState TruthBuilder::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void TruthBuilder::put(TruthState state) {
  {
    const std::lock_guard lock(mutex_);
    if (!worker_.latest().value_or(nullptr)) return;
    state_ = std::move(state);
  }
  wake_();
}

// Where the images of what is wanted by now are the same, what was begun is theirs as well.
bool TruthBuilder::is_still_wanted(const Scene& begun) {
  const Scene wanted = worker_.latest().value_or(nullptr);
  if (!wanted) return false;
  if (wanted->content != begun->content) return false;
  looked_at_ = wanted;
  return true;
}

void TruthBuilder::compose_all(const Scene& scene) {
  ClipTruth clip{.footage = footage_truth_of(*scene)};
  const int total = clip.footage.last_frame - clip.footage.first_frame + 1;
  bool given_up = false;
  looked_at_ = scene;
  const Result<void> made = streamed(stream_, *scene->project, [&](const StreamFrame& frame) -> Result<void> {
    given_up = !is_still_wanted(scene);
    if (given_up) return fail("", "given up", ErrorKind::interrupted);
    const Result<void> added = add_frame(clip, frame.truth);
    if (added && clip.frames() % kFramesAWord == 0) put({.scene = looked_at_, .done = clip.frames(), .total = total});
    return added;
  });
  const Scene belongs_to = std::exchange(looked_at_, nullptr);
  if (given_up) {
    // Or it would not be begun anew should it be wanted again.
    const std::lock_guard lock(mutex_);
    state_ = {};
    return;
  }
  CachedTruth kept{.content = scene->content};
  if (made)
    kept.clip = std::make_shared<const ClipTruth>(std::move(clip));
  else
    kept.problem = made.error().text();
  put({.scene = belongs_to, .clip = kept.clip, .done = total, .total = total, .problem = kept.problem});
  // What failed may do better another time.
  if (kept.clip) made_.push_front(std::move(kept));
  if (made_.size() > kMaxKept) made_.pop_back();
}

void TruthBuilder::build(const Scene& scene) {
  if (!scene || state().scene == scene) return;
  const Result<void> done = guarded([&]() -> Result<void> {
    if (const std::string problem = why_not(*scene); !problem.empty()) {
      put({.scene = scene, .problem = problem});
      return {};
    }
    const auto known = std::find_if(made_.begin(), made_.end(),
                                    [&](const CachedTruth& made) { return made.content == scene->content; });
    if (known != made_.end()) {
      const int frames = known->clip->frames();
      put({.scene = scene, .clip = known->clip, .done = frames, .total = frames});
    } else if (worker_.stays_latest(scene, idle_time_)) {
      compose_all(scene);
    }
    return {};
  });
  if (!done) put({.scene = scene, .problem = done.error().text()});
}

}  // namespace sigs::editor
