// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/content_id.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/worker_thread.h"
#include "evaluation/metrics/track_score.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"
#include "export/frame_stream.h"

namespace sigs::editor {

// Opens the frame stream of a project and composes all of it (engine/export/frame_stream.h). on_frame is called in
// order of the frames; its error ends the stream and is returned. jobs: frames composed in parallel.
[[nodiscard]] Result<void> stream_frames(const Project& project, int jobs,
                                         const std::function<Result<void>(const StreamFrame&)>& on_frame);

// The measured truth of a scene, as far as it is known. Equal to TruthState() where none is wanted or begun.
struct TruthState {
  std::shared_ptr<const OpenedScene> scene;  // the scene that it belongs to; null: nothing is begun yet
  std::shared_ptr<const ClipTruth> clip;     // the truth of all frames; null: not yet, or `problem` says why not at all
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
  ~TruthBuilder() = default;
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
  void put(TruthState state);  // shows a state, unless nothing is wanted any more

  std::function<void()> wake_;
  StreamFrames stream_;
  std::chrono::milliseconds idle_time_;
  mutable std::mutex mutex_;  // guards state_
  TruthState state_;

  // Used by the worker's thread alone, as is looked_at_. Newest first, at most 16.
  std::deque<CachedTruth> made_;
  // The last scene that was wanted while one with the same content was being composed: the truth belongs to it.
  Scene looked_at_;

  LatestRequestWorker<Scene> worker_;  // last: its thread uses all of the above
};

// A file with the results of a tracker in this footage, while it is loaded. Not part of the project.
struct ResultFile {
  int id = 0;  // its own as long as the program runs; 0: none
  std::filesystem::path path;
  int color = 0;         // number of its colour (result_color): the smallest that no other file has
  bool is_shown = true;  // whether its boxes and its curve are drawn; it is scored in any case

  [[nodiscard]] bool operator==(const ResultFile&) const = default;
};

// The files that are loaded, in the order in which they were added. Only names: nothing here reads them.
class ResultFiles {
 public:
  // A path is made absolute first. A file that is loaded already is shown again, and stays one.
  void add(const std::filesystem::path& path);
  void remove(int id);  // passes over ids that are not there; the file on disk stays
  void set_shown(int id, bool shown);
  void clear() { files_.clear(); }
  [[nodiscard]] const std::vector<ResultFile>& files() const { return files_; }

 private:
  std::vector<ResultFile> files_;
  int last_id_ = 0;
};

// By what results are scored: nothing yet, the outlines of the models (known without rendering), or the truth measured
// in rendered frames, which gives the figures of `sigs evaluate track`.
enum class TruthKind { none, outlines, measured };

// One tracker's file, its results and its score, as far as they are known.
struct ScoredTracker {
  ResultFile file;
  std::string name;                         // of the tracker, as the file says it, else from the file's name
  std::string problem;                      // not empty: the file cannot be used, and why, in one line
  std::shared_ptr<const Results> results;   // Null: not read yet, or a problem
  std::shared_ptr<const TrackScore> score;  // Null: not yet, or the intruder is never visible

  [[nodiscard]] bool operator==(const ScoredTracker&) const = default;
};

// What there is to show of trackers at this moment.
struct Scored {
  std::vector<ScoredTracker> trackers;  // in the order of the files
  // Index in the project of the intruder that they are measured against, and its name; "" where it has no path.
  int intruder = 0;
  std::string target;
  int first_frame = 0;  // frame of the footage that index 0 of the scores' frames is
  TruthKind truth = TruthKind::none;
  // Frames of the measured truth that are composed, of truth_total, while it is made.
  int truth_done = 0;
  int truth_total = 0;
  std::string truth_problem;  // why it cannot be measured; "": it is or will be

  [[nodiscard]] bool operator==(const Scored&) const = default;
};

// What is to be scored, against which intruder. scene null or files empty: nothing.
struct ScoringRequest {
  std::shared_ptr<const OpenedScene> scene;
  // One for each of the project's intruders; the outlines come from these.
  std::vector<std::shared_ptr<const Survey>> surveys;
  std::vector<ResultFile> files;
  int intruder = 0;  // index in the project

  [[nodiscard]] bool operator==(const ScoringRequest&) const = default;
};

// Reads result files and scores them in the background, anew whenever a file, the scene or its truth becomes another
// one. Files are looked at once a second; one that has changed is read again when it is the same in two looks, so that
// no half-written file is read. While nothing is loaded, nothing is done. The window's thread calls it, and no call
// waits.
class Scoring {
 public:
  // wake  called from another thread when scored() is another one
  explicit Scoring(std::function<void()> wake, TruthBuilder::StreamFrames show = stream_frames);
  ~Scoring();  // waits for the step that is under way
  Scoring(const Scoring&) = delete;
  Scoring& operator=(const Scoring&) = delete;

  // Once per update. Without files scored() is null at once, and what was read is dropped.
  void want(ScoringRequest wanted);
  // The scores as far as they are known; what it points to never changes. Null: no files are loaded.
  [[nodiscard]] std::shared_ptr<const Scored> scored() const;

 private:
  // A file as it was read last, with its score.
  struct Tracker {
    // When it was read, and at the last look. What is being written is read once it has come to rest.
    FileStamp stamp;
    FileStamp last_stamp;
    FootageTruth footage;  // by which it was read
    // The frame of the footage that the tracker was taken to be started in; none: not known.
    std::optional<int> start_frame;
    std::shared_ptr<const Results> results;
    std::string problem;
    // By which the score was made, and for which target of it; -1: none.
    std::shared_ptr<const ClipTruth> scored_by;
    int target = -1;
    std::shared_ptr<const TrackScore> score;
  };

  // The worker's work: has the truth measured, reads and scores what has changed, and puts the result.
  void update(const ScoringRequest& wanted);
  // The measured truth where it belongs to the wanted scene, else the outlines. Null: neither is there.
  [[nodiscard]] std::shared_ptr<const ClipTruth> clip_of(const ScoringRequest& wanted, const TruthState& truth);
  // Reads the file where it, the footage or the start frame is another one than at the last time.
  void read(Tracker& tracker, const ResultFile& file, const FootageTruth& footage, std::optional<int> start) const;
  // policy none: the target is never visible, so there is no score.
  void score(Tracker& tracker, const std::shared_ptr<const ClipTruth>& clip, int target,
             const std::optional<TrackPolicy>& policy) const;
  // Shows the scores and wakes the window, unless they equal those before.
  void put(std::shared_ptr<const Scored> scored);

  std::function<void()> wake_;
  mutable std::mutex mutex_;  // guards scored_
  std::shared_ptr<const Scored> scored_;

  // By the file's id. Used by the worker's thread alone, as are the outlines: these are kept until the scene or its
  // surveys are others.
  std::map<int, Tracker> trackers_;
  std::shared_ptr<const ClipTruth> outlines_;
  std::shared_ptr<const OpenedScene> outlines_scene_;
  std::vector<std::shared_ptr<const Survey>> outlines_surveys_;

  // Used by the worker's call of step; the truth builder wakes the worker, so the worker is stopped first.
  LatestRequestWorker<ScoringRequest> worker_;
  TruthBuilder truth_;  // wakes the worker
};

}  // namespace sigs::editor
