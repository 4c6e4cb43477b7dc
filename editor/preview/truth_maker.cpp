// SPDX-License-Identifier: MIT
#include "editor/preview/truth_maker.h"

#include <algorithm>
#include <utility>

#include "base/guarded.h"
#include "editor/preview/outline_truth.h"
#include "editor/preview/polite.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kMostKept = 16;
constexpr int kFramesAWord = 8;  // to the window

std::string why_not(const OpenedScene& scene) {
  if (scene.footage && !scene.footage->problem.empty()) return scene.footage->problem;
  if (!scene.draft.problems.empty()) return "the project has problems";
  return {};
}

// Composing may run out of OpenGL or memory.
Result<void> shown(const TruthMaker::ShowFilm& show, const Project& project, const TruthMaker::See& see) {
  return guarded([&] { return show(project, 1, see); }, "composing");
}

}  // namespace

Result<void> film_shown(const Project& project, int jobs, const TruthMaker::See& see) {
  Result<Film> film = Film::open(project);
  if (!film) return fail(film.error());
  const Result<int> damaged = film->show(jobs, see);
  if (!damaged) return fail(damaged.error());
  return {};
}

TruthMaker::TruthMaker(std::function<void()> wake, ShowFilm show, std::chrono::milliseconds rest)
    : wake_(std::move(wake)), show_(std::move(show)), rest_(rest), thread_([this] { run(); }) {}

TruthMaker::~TruthMaker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void TruthMaker::want(std::shared_ptr<const OpenedScene> scene) {
  {
    const std::lock_guard lock(mutex_);
    if (wanted_ == scene) return;
    wanted_ = std::move(scene);
    if (!wanted_) state_ = {};
  }
  changed_.notify_all();
}

TruthState TruthMaker::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void TruthMaker::put(TruthState state) {
  {
    const std::lock_guard lock(mutex_);
    if (!wanted_) return;
    state_ = std::move(state);
  }
  wake_();
}

TruthMaker::Scene TruthMaker::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return stop_ || (wanted_ && wanted_ != state_.scene); });
  return stop_ ? nullptr : wanted_;
}

bool TruthMaker::has_rested(const Scene& scene) {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, rest_, [&] { return stop_ || wanted_ != scene; });
}

// Where the pictures of what is wanted by now are the same, what was begun is theirs as well.
bool TruthMaker::goes_on(const Scene& begun, const PictureName& name) {
  Scene wanted;
  {
    const std::lock_guard lock(mutex_);
    if (stop_ || !wanted_) return false;
    wanted = wanted_;
  }
  if (wanted == begun || wanted == looked_at_) return true;
  if (picture_name_of(*wanted->project) != name) return false;
  looked_at_ = wanted;
  return true;
}

void TruthMaker::make(const Scene& scene, PictureName name) {
  FilmTruth film{.footage = footage_truth_of(*scene)};
  const int total = film.footage.last_frame - film.footage.first_frame + 1;
  bool given_up = false;
  looked_at_ = scene;
  const Result<void> made = shown(show_, *scene->project, [&](const FilmFrame& frame) -> Result<void> {
    given_up = !goes_on(scene, name);
    if (given_up) return fail("", "given up", ErrorKind::interrupted);
    const Result<void> added = add_frame(film, frame.truth);
    if (added && film.frames() % kFramesAWord == 0) put({.scene = looked_at_, .done = film.frames(), .total = total});
    return added;
  });
  const Scene belongs_to = std::exchange(looked_at_, nullptr);
  if (given_up) {
    // Or it would not be begun anew should it be wanted again.
    const std::lock_guard lock(mutex_);
    state_ = {};
    return;
  }
  Made kept{.name = std::move(name)};
  if (made)
    kept.film = std::make_shared<const FilmTruth>(std::move(film));
  else
    kept.problem = made.error().text();
  put({.scene = belongs_to, .film = kept.film, .done = total, .total = total, .problem = kept.problem});
  // What failed may do better another time.
  if (kept.film) made_.push_front(std::move(kept));
  if (made_.size() > kMostKept) made_.pop_back();
}

void TruthMaker::run() {
  be_polite(kNicenessOfExport);
  while (const Scene scene = next()) {
    const Result<void> done = guarded([&]() -> Result<void> {
      show_truth_of(scene);
      return {};
    });
    if (!done) put({.scene = scene, .problem = done.error().text()});
  }
}

void TruthMaker::show_truth_of(const Scene& scene) {
  if (const std::string problem = why_not(*scene); !problem.empty()) {
    return put({.scene = scene, .problem = problem});
  }
  PictureName name = picture_name_of(*scene->project);
  const auto known = std::find_if(made_.begin(), made_.end(), [&](const Made& made) { return made.name == name; });
  if (known != made_.end()) {
    const int frames = known->film->frames();
    put({.scene = scene, .film = known->film, .done = frames, .total = frames});
  } else if (has_rested(scene)) {
    make(scene, std::move(name));
  }
}

}  // namespace sigs::editor
