// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "editor/document/content_id.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/worker_thread.h"
#include "evaluation/clip_truth.h"
#include "export/frame_stream.h"

namespace sigs::editor {

// Opens the frame stream of a project and composes all of it (engine/export/frame_stream.h).
[[nodiscard]] Result<void> stream_frames(const Project& project, int jobs,
                                         const std::function<Result<void>(const StreamFrame&)>& on_frame);

// The measured truth of a scene, as far as it is known.
struct TruthState {
  std::shared_ptr<const OpenedScene> scene;  // that it belongs to
  std::shared_ptr<const ClipTruth> clip;     // null: not yet, or not at all
  int done = 0;                              // frames
  int total = 0;
  std::string problem;  // why there is none
};

// Composes all frames of a project in the background, at low priority, and keeps the truth of each: the one that an
// export writes and that `sigs evaluate` measures by. It begins once no edit has come for idle_time, gives up as soon
// as another content is wanted, and remembers the last 16 contents, so that undo finds their truth at once.
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

  // The scene whose truth is wanted. Null: none; what is under way ends.
  void want(std::shared_ptr<const OpenedScene> scene);
  [[nodiscard]] TruthState state() const;

 private:
  using Scene = std::shared_ptr<const OpenedScene>;
  struct CachedTruth {
    ContentId content;
    std::shared_ptr<const ClipTruth> clip;  // null: it failed
    std::string problem;
  };

  void build(const Scene& scene);
  [[nodiscard]] bool is_still_wanted(const Scene& begun);
  void compose_all(const Scene& scene);
  void put(TruthState state);

  std::function<void()> wake_;
  StreamFrames stream_;
  std::chrono::milliseconds idle_time_;
  mutable std::mutex mutex_;
  TruthState state_;

  // The thread's own.
  std::deque<CachedTruth> made_;  // newest first
  Scene looked_at_;  // the last that was wanted while another one was being composed, and has the same content

  LatestRequestWorker<Scene> worker_;  // last: it uses all of the above
};

}  // namespace sigs::editor
