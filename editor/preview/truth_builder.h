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
#include "evaluation/readers/clip_truth.h"
#include "export/frame_stream.h"

namespace sigs::editor {

// Opens the frame stream of a project and composes all of it (engine/export/frame_stream.h). on_frame is called in
// order of the frames; its error ends the stream and is returned. jobs: frames composed in parallel.
[[nodiscard]] Result<void> stream_frames(const Project& project, int jobs,
                                         const std::function<Result<void>(const StreamFrame&)>& on_frame);

// The measured truth of a scene, as far as it is known. Equal to TruthState() where none is wanted or begun.
struct TruthState {
  // The scene that it belongs to; null: nothing is begun yet.
  std::shared_ptr<const OpenedScene> scene;
  // The truth of all frames; null: not yet, or `problem` says why not at all.
  std::shared_ptr<const ClipTruth> clip;
  // Frames that are composed, of `total`.
  int done = 0;
  int total = 0;
  // Why there is none: problems of the project or its footage, or composing failed. "": there is, or there will be.
  std::string problem;
};

// Composes all frames of a project in the background, at low priority, and keeps the truth of each: the one that an
// export writes and that `sigs evaluate` measures by. It begins once no edit has come for idle_time, gives up as soon
// as another content is wanted, and remembers the last 16 contents, so that undo finds their truth at once.
// Its calls may come from any thread.
class TruthBuilder {
 public:
  using OnFrame = std::function<Result<void>(const StreamFrame&)>;
  using StreamFrames = std::function<Result<void>(const Project&, int jobs, const OnFrame&)>;

  // wake       called from another thread when state() is another one, while it composes after every eighth frame
  // show       what composes; tests give one of their own
  // idle_time  how long a scene has to stay wanted before it is begun
  explicit TruthBuilder(std::function<void()> wake, StreamFrames show = stream_frames,
                        std::chrono::milliseconds idle_time = std::chrono::milliseconds(500));
  // Gives up what is under way, and waits until that has noticed, at its next frame.
  ~TruthBuilder();
  TruthBuilder(const TruthBuilder&) = delete;
  TruthBuilder& operator=(const TruthBuilder&) = delete;

  // The scene whose truth is wanted. Null: none; what is under way ends, and state() is empty. A scene with the same
  // content as the one that is under way takes over what was composed.
  void want(std::shared_ptr<const OpenedScene> scene);
  // A copy; never waits. Until a wanted scene is begun, it may still be that of the scene before.
  [[nodiscard]] TruthState state() const;

 private:
  using Scene = std::shared_ptr<const OpenedScene>;
  struct CachedTruth {
    ContentId content;
    std::shared_ptr<const ClipTruth> clip;
    std::string problem;
  };

  // The worker's work: answers at once where the truth is known or cannot be, else waits and composes.
  void build(const Scene& scene);
  // Whether the wanted content is still that of `begun`; remembers the scene that is wanted in looked_at_.
  [[nodiscard]] bool is_still_wanted(const Scene& begun);
  void compose_all(const Scene& scene);
  // Shows a state, unless nothing is wanted any more.
  void put(TruthState state);

  std::function<void()> wake_;
  StreamFrames stream_;
  std::chrono::milliseconds idle_time_;
  // Guards state_.
  mutable std::mutex mutex_;
  TruthState state_;

  // Used by the worker's thread alone, as is looked_at_. Newest first, at most 16.
  std::deque<CachedTruth> made_;
  // The last scene that was wanted while one with the same content was being composed: the truth belongs to it.
  Scene looked_at_;

  // Last: its thread uses all of the above.
  LatestRequestWorker<Scene> worker_;
};

}  // namespace sigs::editor
