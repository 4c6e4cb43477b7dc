// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "evaluation/detection_score.h"
#include "evaluation/track_score.h"

namespace sigs {

// Several trackers on one clip.
struct TrackReport {
  std::string clip;  // the project's or label file's name
  FootageTruth footage;
  std::string target;
  TrackPolicy policy;
  std::vector<TrackScore> scores;
  std::vector<std::string> remarks;  // a tracker that could not be started, ...
};

// Several detectors on the same clips.
struct DetectionReport {
  std::vector<std::string> clips;
  DetectionPolicy policy;
  std::vector<DetectionScore> scores;
};

// A table for a terminal: one row for each tracker or detector.
[[nodiscard]] std::string table_text(const TrackReport& report);
[[nodiscard]] std::string table_text(const DetectionReport& report);

// What the figures count and what they do not, one sentence each; docs/evaluation.md says why.
[[nodiscard]] std::vector<std::string> policies_of(const TrackReport& report);
[[nodiscard]] std::vector<std::string> policies_of(const DetectionReport& report);

// Why fewer encounters count than a reader may look for, one sentence for each reason; empty: all count.
[[nodiscard]] std::vector<std::string> uncounted_in(const DetectionReport& report);

struct WrittenReport {
  std::vector<std::filesystem::path> files;
  std::vector<Warning> warnings;  // gnuplot is missing: no plots
};

// Writes into folder, which is there: summary.csv, frames.csv, evaluation.json; where gnuplot is installed
// center_error, x_error, y_error, precision, success and normalized_precision as .svg and .png; report.html, which
// holds all it shows and opens from disk. The same report gives the same bytes; speeds in it are measured, so they
// differ from run to run.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const TrackReport& report);

// The same with summary.csv, encounters.csv, evaluation.json, the plots detection_rate and first_range, report.html.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const DetectionReport& report);

// Whether a file of this name in a report's folder may be one that write_report wrote.
[[nodiscard]] bool is_report_file(const std::string& name);

}  // namespace sigs
