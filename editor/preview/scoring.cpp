// SPDX-License-Identifier: MIT
#include "editor/preview/scoring.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/threads.h"
#include "editor/preview/surveys.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kMaxKept = 16;
constexpr int kFramesAWord = 8;  // to the window

std::string why_not(const OpenedScene& scene) {
  if (scene.footage && !scene.footage->problem.empty()) return scene.footage->problem;
  if (!scene.draft.problems.empty()) return "the project has problems";
  return {};
}

constexpr double kMinSide_px = 0;  // of the first box that a tracker is started with

bool is_same(const FootageTruth& a, const FootageTruth& b) {
  return a.video == b.video && a.size_px == b.size_px && a.first_frame == b.first_frame &&
         a.last_frame == b.last_frame && a.frame_rate_num == b.frame_rate_num && a.frame_rate_den == b.frame_rate_den;
}

const TargetTruth* target_in(const ClipTruth& clip, int id) {
  const auto found = std::ranges::find(clip.targets, id, &TargetTruth::id);
  return found == clip.targets.end() ? nullptr : &*found;
}

// Number in the scene of the project's intruder; -1: it flies nowhere, or there is none.
int target_of(const ScoringRequest& wanted) {
  const std::vector<int>& ids = wanted.scene->draft.intruder_of_project;
  const auto intruder = static_cast<std::size_t>(wanted.intruder);
  return wanted.intruder >= 0 && intruder < ids.size() ? ids[intruder] : -1;
}

// As `sigs evaluate track` measures where nothing else is asked for; none: the target is never visible.
std::optional<TrackPolicy> policy_for(const ClipTruth* clip, int target) {
  const TargetTruth* const truth = clip == nullptr ? nullptr : target_in(*clip, target);
  return truth == nullptr ? std::nullopt : policy_from_start(*clip, *truth);
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
  const auto on_frame = [&](const StreamFrame& frame) -> Result<void> {
    given_up = !is_still_wanted(scene);
    if (given_up) return fail("", "given up", ErrorKind::interrupted);
    const Result<void> added = add_frame(clip, frame.truth);
    if (added && clip.frames() % kFramesAWord == 0) put({.scene = looked_at_, .done = clip.frames(), .total = total});
    return added;
  };
  // Composing may run out of OpenGL or memory.
  const Result<void> made = guarded([&] { return stream_(*scene->project, 1, on_frame); }, "composing");
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
    const auto known = std::ranges::find(made_, scene->content, &CachedTruth::content);
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

namespace fs = std::filesystem;

void ResultFiles::add(const fs::path& path) {
  std::error_code code;
  const fs::path absolute = fs::absolute(path, code);
  const fs::path place = (code ? path : absolute).lexically_normal();
  const auto same = std::ranges::find(files_, place, &ResultFile::path);
  if (same != files_.end()) {
    same->is_shown = true;
    return;
  }
  int color = 0;
  while (std::ranges::find(files_, color, &ResultFile::color) != files_.end()) ++color;
  files_.push_back({.id = ++last_id_, .path = place, .color = color});
}

void ResultFiles::remove(int id) {
  std::erase_if(files_, [id](const ResultFile& file) { return file.id == id; });
}

void ResultFiles::set_shown(int id, bool shown) {
  for (ResultFile& file : files_)
    if (file.id == id) file.is_shown = shown;
}

Scoring::Scoring(std::function<void()> wake, TruthBuilder::StreamFrames show)
    : wake_(std::move(wake)),
      worker_({.work = [this](const ScoringRequest& wanted) { update(wanted); },
               .niceness = kPreviewNiceness,
               .repeat_after = [](const ScoringRequest& wanted) -> std::optional<std::chrono::milliseconds> {
                 return wanted.files.empty() ? std::nullopt : std::optional(kFileCheckInterval);
               }}),
      truth_([this] { worker_.wake(); }, std::move(show)) {}

// The builder may wake the worker until its own thread has ended.
Scoring::~Scoring() {
  worker_.stop();
}

void Scoring::want(ScoringRequest wanted) {
  const std::lock_guard lock(mutex_);
  if (wanted.files.empty()) {
    scored_ = nullptr;
    wanted = {};
  }
  worker_.want(std::move(wanted));
}

std::shared_ptr<const Scored> Scoring::scored() const {
  const std::lock_guard lock(mutex_);
  return scored_;
}

void Scoring::put(std::shared_ptr<const Scored> scored) {
  {
    const std::lock_guard lock(mutex_);
    const std::optional<ScoringRequest> wanted = worker_.latest();
    if (!wanted || wanted->files.empty() || (scored_ && *scored_ == *scored)) return;
    scored_ = std::move(scored);
  }
  wake_();
}

void Scoring::read(Tracker& tracker, const ResultFile& file, const FootageTruth& footage,
                   std::optional<int> start) const {
  const FileStamp stamp = stamp_of(file.path);
  const FileStamp before = std::exchange(tracker.last_stamp, stamp);
  const bool is_known = tracker.results || !tracker.problem.empty();
  const bool is_old = stamp != tracker.stamp && stamp == before;
  if (is_known && !is_old && is_same(footage, tracker.footage) && start == tracker.start_frame) return;
  tracker = {.stamp = stamp, .last_stamp = stamp, .footage = footage, .start_frame = start};
  Result<Results> read =
      guarded([&] { return read_results(file.path, footage, {.start_frame = start}); }, file.path.string());
  if (read)
    tracker.results = std::make_shared<const Results>(std::move(*read));
  else
    tracker.problem = read.error().text();
}

// What was measured counts for the scene that it belongs to alone; until it is there, the outlines. Those of the scene
// before stay as long as the surveys are not complete.
std::shared_ptr<const ClipTruth> Scoring::clip_of(const ScoringRequest& wanted, const TruthState& truth) {
  if (truth.clip && truth.scene == wanted.scene) return truth.clip;
  if (outlines_scene_ != wanted.scene || outlines_surveys_ != wanted.surveys) {
    outlines_scene_ = wanted.scene;
    outlines_surveys_ = wanted.surveys;
    if (std::shared_ptr<const ClipTruth> made = outline_truth(*wanted.scene, wanted.surveys))
      outlines_ = std::move(made);
  }
  const bool fits = outlines_ && is_same(outlines_->footage, footage_truth_of(*wanted.scene));
  return fits ? outlines_ : nullptr;
}

void Scoring::score(Tracker& tracker, const std::shared_ptr<const ClipTruth>& clip, int target,
                    const std::optional<TrackPolicy>& policy) const {
  if (!tracker.results || !clip || (tracker.scored_by == clip && tracker.target == target)) return;
  tracker.scored_by = clip;
  tracker.target = target;
  tracker.score = nullptr;
  if (policy)
    tracker.score =
        std::make_shared<const TrackScore>(score_track(*clip, *target_in(*clip, target), *tracker.results, *policy));
}

// What fails for want of memory is tried again at the next look at the files.
void Scoring::update(const ScoringRequest& wanted) {
  const bool has_work = !wanted.files.empty() && wanted.scene;
  truth_.want(has_work ? wanted.scene : nullptr);
  if (!has_work) {
    trackers_.clear();
    return;
  }
  const FootageTruth footage = footage_truth_of(*wanted.scene);
  const TruthState truth = truth_.state();
  const std::shared_ptr<const ClipTruth> clip = clip_of(wanted, truth);
  const bool is_of_scene = truth.scene == wanted.scene;
  const int target = target_of(wanted);
  const std::optional<TrackPolicy> policy = policy_for(clip.get(), target);
  auto scored = std::make_shared<Scored>(Scored{.intruder = wanted.intruder, .first_frame = footage.first_frame});
  if (target >= 0) scored->target = wanted.scene->draft.scene.intruders[static_cast<std::size_t>(target)].name;
  if (clip) scored->truth = clip == truth.clip ? TruthKind::measured : TruthKind::outlines;
  if (is_of_scene) {
    scored->truth_done = truth.done;
    scored->truth_total = truth.total;
    scored->truth_problem = truth.problem;
  }
  std::erase_if(trackers_, [&](const auto& known) {
    return std::ranges::none_of(wanted.files, [&](const ResultFile& file) { return file.id == known.first; });
  });
  for (const ResultFile& file : wanted.files) {
    Tracker& tracker = trackers_[file.id];
    read(tracker, file, footage, policy ? std::optional(policy->from_frame) : std::nullopt);
    score(tracker, clip, target, policy);
    scored->trackers.push_back({.file = file,
                                .name = tracker.results ? tracker.results->name : results_name(file.path),
                                .problem = tracker.problem,
                                .results = tracker.results,
                                .score = tracker.score});
  }
  put(std::move(scored));
}

}  // namespace sigs::editor
