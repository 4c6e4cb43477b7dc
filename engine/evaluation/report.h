// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "evaluation/detection_score.h"
#include "evaluation/track_score.h"

namespace sigs {

// Several trackers on one film.
struct TrackReport {
  std::string film;  // the project's or label file's name
  FootageTruth footage;
  std::string target;
  TrackPolicy policy;
  std::vector<TrackScore> scores;
  std::vector<std::string> remarks;  // a tracker that could not be started, ...
};

// A table for a terminal: one row a tracker.
[[nodiscard]] std::string table_text(const TrackReport& report);
[[nodiscard]] std::string table_text(const DetectionScore& score);

// Writes into folder: summary.csv, frames.csv, evaluation.json; where gnuplot is installed center_error, x_error,
// y_error, precision, success and normalized_precision as .svg and .png; report.html, which holds all it shows and
// opens from disk. Returns what was written; a missing gnuplot is said in `warnings`.
struct WrittenReport {
  std::vector<std::filesystem::path> files;
  std::vector<Warning> warnings;
};
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const TrackReport& report);
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder,
                                                 const std::vector<DetectionScore>& scores,
                                                 const DetectionPolicy& policy);

}  // namespace sigs
