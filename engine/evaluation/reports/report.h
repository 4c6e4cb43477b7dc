// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "evaluation/metrics/aot_rules.h"
#include "evaluation/metrics/detection_score.h"
#include "evaluation/metrics/rig_score.h"
#include "evaluation/metrics/slices.h"
#include "evaluation/metrics/track_score.h"

namespace sigs {

// The report of an evaluation: a table, and a folder with CSV and JSON files, plots and a page.

// The scores of several trackers on one clip.
struct TrackReport {
  std::string clip;  // the project's or label file's name
  FootageTruth footage;
  std::string target;  // name of the intruder that was followed
  TrackPolicy policy;
  std::vector<TrackScore> scores;
  std::vector<std::string> remarks;  // a tracker that could not be started, ...
};

// The scores of several detectors on the same clips.
struct DetectionReport {
  std::vector<std::string> clips;
  DetectionPolicy policy;
  std::vector<DetectionScore> scores;
  std::vector<std::vector<FrameSlice>> slices;  // of each detector; empty: not asked for
  std::vector<std::string> remarks = {};        // what the truth does not say (left_out_of)
};

// The scores of several detectors on the cameras of one rig.
struct RigDetectionReport {
  std::string rig;
  std::vector<std::string> cameras;
  DetectionPolicy policy;
  std::vector<RigScore> scores;
};

// A table for a terminal: one row for each tracker or detector.
[[nodiscard]] std::string table_text(const TrackReport& report);
[[nodiscard]] std::string table_text(const DetectionReport& report);
[[nodiscard]] std::string table_text(const TrackSetReport& report);

// Of a rig: a row for each detector and intruder, and for each camera that shows it; then a row for each handover.
[[nodiscard]] std::string table_text(const RigDetectionReport& report);

[[nodiscard]] std::string aot_table(const AotScore& score);  // by the rules of the Airborne Object Tracking challenge

// What the figures count and what they leave out, as sentences; docs/evaluation.md gives the reasons.
[[nodiscard]] std::vector<std::string> policies_of(const TrackReport& report);
[[nodiscard]] std::vector<std::string> policies_of(const DetectionReport& report);
[[nodiscard]] std::vector<std::string> policies_of(const TrackSetReport& report);
[[nodiscard]] std::vector<std::string> policies_of(const RigDetectionReport& report);

// Frames matched by range, size, contrast, horizon and visible share, a row for each slice that has frames and a column
// for each detector.
[[nodiscard]] std::string slices_text(const DetectionReport& report);

// How sure the encounter detection rates are: a line for each detector, then one for each detector against the first.
// Detectors must have been scored on the same clips.
[[nodiscard]] std::string intervals_text(const DetectionReport& report);

// The same of trackers on many clips: the mean overlap in frames of each slice; success AUC by drawing clips.
[[nodiscard]] std::string slices_text(const TrackSetReport& report);
[[nodiscard]] std::string intervals_text(const TrackSetReport& report);

// Why encounters are not counted, a sentence for each reason; empty: all are.
[[nodiscard]] std::vector<std::string> uncounted_in(const DetectionReport& report);

// What write_report() has written.
struct WrittenReport {
  std::vector<std::filesystem::path> files;
};

// Writes into a folder, which must exist; files of the same name are replaced. The files are summary.csv, frames.csv
// and evaluation.json; the plots center_error, x_error, y_error, precision, success and normalized_precision as .svg
// and .png; and report.html, a page that needs no other file. The same report gives the same
// bytes; measured speeds in it differ from run to run. Errors cannot_create, write_failed.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const TrackReport& report);

// The same with summary.csv, encounters.csv, slices.csv, evaluation.json, the plots detection_rate and first_range, and
// report.html.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const DetectionReport& report);

// Of trackers on many clips: summary.csv, clips.csv, slices.csv, evaluation.json, the plots precision, success and
// normalized_precision, and report.html.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const TrackSetReport& report);

// Of a rig: summary.csv, handovers.csv, evaluation.json and report.html.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const RigDetectionReport& report);

// By the rules of the Airborne Object Tracking challenge: summary.json, encounters_by_detection.csv and
// encounters_by_track.csv, as its own program writes them.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const AotTruth& truth,
                                                 const AotScore& score);

// Whether write_report() writes files of this name.
[[nodiscard]] bool is_report_file(const std::string& name);

}  // namespace sigs
