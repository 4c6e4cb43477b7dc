// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "editor/preview/picture_names.h"
#include "editor/preview/previewer.h"
#include "evaluation/truth.h"
#include "film.h"

namespace sigs::editor {

// Opens the film of a project and shows all of it (engine/film.h).
[[nodiscard]] Result<void> film_shown(const Project& project, int jobs,
                                      const std::function<Result<void>(const FilmFrame&)>& see);

// The measured truth of a scene's film as it stands.
struct TruthState {
  std::shared_ptr<const OpenedScene> scene;  // that it belongs to
  std::shared_ptr<const FilmTruth> film;     // null: not yet, or not at all
  int done = 0;                              // frames
  int total = 0;
  std::string problem;  // why there is none
};

// Composes all frames of a project in the background, at low priority, and keeps what they show of the intruders: the
// truth that an export writes and `sigs evaluate` measures by. Begins when edits have come to rest, is given up as soon
// as the pictures would be others, and remembers the last few: undo finds them at once.
class TruthMaker {
 public:
  using See = std::function<Result<void>(const FilmFrame&)>;
  using ShowFilm = std::function<Result<void>(const Project&, int jobs, const See&)>;

  // wake  called from another thread when state() is another one
  explicit TruthMaker(std::function<void()> wake, ShowFilm show = film_shown,
                      std::chrono::milliseconds rest = std::chrono::milliseconds(500));
  ~TruthMaker();
  TruthMaker(const TruthMaker&) = delete;
  TruthMaker& operator=(const TruthMaker&) = delete;

  // Null: nothing is wanted, what is under way ends.
  void want(std::shared_ptr<const OpenedScene> scene);
  [[nodiscard]] TruthState state() const;

 private:
  using Scene = std::shared_ptr<const OpenedScene>;
  struct Made {
    PictureName name;
    std::shared_ptr<const FilmTruth> film;  // null: it failed
    std::string problem;
  };

  void run();
  void show_truth_of(const Scene& scene);
  [[nodiscard]] Scene next();                         // waits; null: stop
  [[nodiscard]] bool has_rested(const Scene& scene);  // waits; false: another one is wanted meanwhile
  [[nodiscard]] bool goes_on(const Scene& begun, const PictureName& name);
  void make(const Scene& scene, PictureName name);
  void put(TruthState state);

  std::function<void()> wake_;
  ShowFilm show_;
  std::chrono::milliseconds rest_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  Scene wanted_;
  TruthState state_;

  // The thread's own.
  std::deque<Made> made_;  // newest first
  Scene looked_at_;        // the last that was wanted while another was under way, and is the same to look at
  std::thread thread_;
};

}  // namespace sigs::editor
