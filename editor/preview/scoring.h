// SPDX-License-Identifier: MIT
#pragma once

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
#include "editor/preview/truth_builder.h"
#include "editor/preview/worker_thread.h"
#include "evaluation/readers/results.h"
#include "evaluation/metrics/track_score.h"

namespace sigs::editor {

// A file with the results of a tracker in this footage, while it is loaded. Not part of the project.
struct ResultFile {
  // Its own as long as the program runs; 0: none.
  int id = 0;
  std::filesystem::path path;
  // Number of its colour (result_color): the smallest that no other file has.
  int color = 0;
  // Whether its boxes and its curve are drawn. It is scored in any case.
  bool is_shown = true;

  [[nodiscard]] bool operator==(const ResultFile&) const = default;
};

// The files that are loaded, in the order in which they were added. Only names: nothing here reads them.
class ResultFiles {
 public:
  // A path is made absolute first. A file that is loaded already is shown again, and stays one.
  void add(const std::filesystem::path& path);
  // Ids that are not there are passed over. The file on disk stays.
  void remove(int id);
  void set_shown(int id, bool shown);
  void clear() { files_.clear(); }
  [[nodiscard]] const std::vector<ResultFile>& files() const { return files_; }

 private:
  // The smallest number that no file has.
  [[nodiscard]] int free_color() const;

  std::vector<ResultFile> files_;
  int last_id_ = 0;
};

// By what results are scored: nothing yet, the outlines of the models (known without rendering), or the truth measured
// in rendered frames, which gives the figures of `sigs evaluate track`.
enum class TruthKind { none, outlines, measured };

// One tracker's file, its results and its score, as far as they are known.
struct ScoredTracker {
  ResultFile file;
  // Of the tracker, as the file says it, else from the file's name.
  std::string name;
  // Not empty: the file cannot be used, and why, in one line.
  std::string problem;
  // Null: not read yet, or a problem.
  std::shared_ptr<const Results> results;
  // Null: not yet, or the intruder is never visible.
  std::shared_ptr<const TrackScore> score;

  [[nodiscard]] bool operator==(const ScoredTracker&) const = default;
};

// What there is to show of trackers at this moment.
struct Scored {
  // In the order of the files.
  std::vector<ScoredTracker> trackers;
  // Index in the project of the intruder that they are measured against, and its name; "" where it has no path.
  int intruder = 0;
  std::string target;
  // Frame of the footage that index 0 of the scores' frames is.
  int first_frame = 0;
  TruthKind truth = TruthKind::none;
  // Frames of the measured truth that are composed, of truth_total, while it is made.
  int truth_done = 0;
  int truth_total = 0;
  // Why it cannot be measured; "": it is or will be.
  std::string truth_problem;

  [[nodiscard]] bool operator==(const Scored&) const = default;
};

// What is to be scored, against which intruder. scene null or files empty: nothing.
struct ScoringRequest {
  std::shared_ptr<const OpenedScene> scene;
  // One for each of the project's intruders; the outlines come from these.
  std::vector<std::shared_ptr<const Survey>> surveys;
  std::vector<ResultFile> files;
  // Index in the project.
  int intruder = 0;

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
  // Waits for the step that is under way.
  ~Scoring();
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
    // By which it was read.
    FootageTruth footage;
    // The frame of the footage that the tracker was taken to be started in; none: not known.
    std::optional<int> start_frame;
    std::shared_ptr<const Results> results;
    std::string problem;
    // By which the score was made, and for which target of it; -1: none.
    std::shared_ptr<const ClipTruth> scored_by;
    int target = -1;
    std::shared_ptr<const TrackScore> score;
  };

  // The worker's work: has the truth measured, then makes one step.
  void update(const ScoringRequest& wanted);
  // Reads and scores what has changed, and puts the result.
  void step(const ScoringRequest& wanted);
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
  // Guards scored_.
  mutable std::mutex mutex_;
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
