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

#include "editor/preview/content_id.h"
#include "editor/preview/previewer.h"
#include "evaluation/clip_truth.h"
#include "export/frame_stream.h"

namespace sigs::editor {

// Opens the frame stream of a project and composes all of it (engine/export/frame_stream.h).
[[nodiscard]] Result<void> stream_frames(const Project& project, int jobs,
                                         const std::function<Result<void>(const StreamFrame&)>& on_frame);

// The measured truth of a scene's footage as it stands.
struct TruthState {
  std::shared_ptr<const OpenedScene> scene;  // that it belongs to
  std::shared_ptr<const ClipTruth> clip;     // null: not yet, or not at all
  int done = 0;                              // frames
  int total = 0;
  std::string problem;  // why there is none
};

// Composes all frames of a project in the background, at low priority, and keeps what they show of the intruders: the
// truth that an export writes and `sigs evaluate` measures by. Begins when edits have come to rest, is given up as soon
// as the images would be others, and remembers the last few: undo finds them at once.
class TruthBuilder {
 public:
  using OnFrame = std::function<Result<void>(const StreamFrame&)>;
  using StreamFrames = std::function<Result<void>(const Project&, int jobs, const OnFrame&)>;

  // wake  called from another thread when state() is another one
  explicit TruthBuilder(std::function<void()> wake, StreamFrames show = stream_frames,
                        std::chrono::milliseconds idle_time = std::chrono::milliseconds(500));
  ~TruthBuilder();
  TruthBuilder(const TruthBuilder&) = delete;
  TruthBuilder& operator=(const TruthBuilder&) = delete;

  // Null: nothing is wanted, what is under way ends.
  void want(std::shared_ptr<const OpenedScene> scene);
  [[nodiscard]] TruthState state() const;

 private:
  using Scene = std::shared_ptr<const OpenedScene>;
  struct CachedTruth {
    ContentId name;
    std::shared_ptr<const ClipTruth> clip;  // null: it failed
    std::string problem;
  };

  void run();
  void show_truth_of(const Scene& scene);
  [[nodiscard]] Scene next();                            // waits; null: stop
  [[nodiscard]] bool has_been_idle(const Scene& scene);  // waits; false: another one is wanted meanwhile
  [[nodiscard]] bool is_still_wanted(const Scene& begun, const ContentId& name);
  void make(const Scene& scene, ContentId name);
  void put(TruthState state);

  std::function<void()> wake_;
  StreamFrames stream_;
  std::chrono::milliseconds idle_time_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  Scene wanted_;
  TruthState state_;

  // The thread's own.
  std::deque<CachedTruth> made_;  // newest first
  Scene looked_at_;               // the last that was wanted while another was under way, and is the same to look at
  std::thread thread_;
};

}  // namespace sigs::editor
