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
#include "evaluation/results.h"
#include "evaluation/track_score.h"

namespace sigs::editor {

// A file with the results of a tracker in this footage, while it is loaded. Not part of the project.
struct ResultFile {
  int id = 0;  // its own as long as the program runs; 0: none
  std::filesystem::path path;
  int color = 0;         // number of its colour: the smallest that no other file has
  bool is_shown = true;  // whether its boxes and its curve are drawn

  [[nodiscard]] bool operator==(const ResultFile&) const = default;
};

// The files that are loaded, in the order in which they were added.
class ResultFiles {
 public:
  // A file that is loaded already is shown again, and stays one.
  void add(const std::filesystem::path& path);
  void remove(int id);
  void set_shown(int id, bool shown);
  void clear() { files_.clear(); }
  [[nodiscard]] const std::vector<ResultFile>& files() const { return files_; }

 private:
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
  std::string name;
  std::string problem;                      // not empty: the file cannot be used, and why, in one line
  std::shared_ptr<const Results> results;   // null: not read yet, or a problem
  std::shared_ptr<const TrackScore> score;  // null: not yet

  [[nodiscard]] bool operator==(const ScoredTracker&) const = default;
};

// What there is to show of trackers at this moment.
struct Scored {
  std::vector<ScoredTracker> trackers;  // in the order of the files
  int intruder = 0;                     // of the project, that they are measured against
  std::string target;                   // its name
  int first_frame = 0;                  // of the scores' frames
  TruthKind truth = TruthKind::none;
  int truth_done = 0;  // frames of the measured truth, while it is made
  int truth_total = 0;
  std::string truth_problem;  // why it cannot be measured

  [[nodiscard]] bool operator==(const Scored&) const = default;
};

struct ScoringRequest {
  std::shared_ptr<const OpenedScene> scene;
  std::vector<std::shared_ptr<const Survey>> surveys;  // one for each of the project's intruders
  std::vector<ResultFile> files;
  int intruder = 0;  // of the project

  [[nodiscard]] bool operator==(const ScoringRequest&) const = default;
};

// Reads result files and scores them in the background, anew whenever a file, the scene or its truth becomes another
// one. While nothing is loaded, nothing is done.
class Scoring {
 public:
  // wake  called from another thread when scored() is another one
  explicit Scoring(std::function<void()> wake, TruthBuilder::StreamFrames show = stream_frames);
  ~Scoring();
  Scoring(const Scoring&) = delete;
  Scoring& operator=(const Scoring&) = delete;

  void want(ScoringRequest wanted);
  // The scores as far as they are known; what it points to never changes. Null: no files are loaded.
  [[nodiscard]] std::shared_ptr<const Scored> scored() const;

 private:
  // A file as it was read last, with its score.
  struct Tracker {
    FileStamp stamp;
    FileStamp last_stamp;  // at the last look: what is being written is read once it has come to rest
    FootageTruth footage;
    std::optional<int> start_frame;  // it was taken to be started in this one
    std::shared_ptr<const Results> results;
    std::string problem;
    std::shared_ptr<const ClipTruth> scored_by;
    int target = -1;
    std::shared_ptr<const TrackScore> score;
  };

  void update(const ScoringRequest& wanted);
  void step(const ScoringRequest& wanted);
  [[nodiscard]] std::shared_ptr<const ClipTruth> clip_of(const ScoringRequest& wanted, const TruthState& truth);
  void read(Tracker& tracker, const ResultFile& file, const FootageTruth& footage, std::optional<int> start) const;
  void score(Tracker& tracker, const std::shared_ptr<const ClipTruth>& clip, int target,
             const std::optional<TrackPolicy>& policy) const;
  void put(std::shared_ptr<const Scored> scored);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Scored> scored_;

  // The thread's own.
  std::map<int, Tracker> trackers_;  // by the file's id
  std::shared_ptr<const ClipTruth> outlines_;
  std::shared_ptr<const OpenedScene> outlines_scene_;
  std::vector<std::shared_ptr<const Survey>> outlines_surveys_;

  LatestRequestWorker<ScoringRequest> worker_;
  TruthBuilder truth_;  // wakes the worker
};

}  // namespace sigs::editor
