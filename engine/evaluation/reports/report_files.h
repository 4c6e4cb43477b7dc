// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/reports/report.h"
#include "plot/plot.h"

namespace sigs {

// The contents of the files of a report (report.h), each as text. Numbers are the shortest that read back the same;
// what does not exist is empty in CSV and null in JSON.

[[nodiscard]] std::string summary_csv(const TrackReport& report);      // a row for each tracker
[[nodiscard]] std::string frames_csv(const TrackReport& report);       // a row for each tracker and frame
[[nodiscard]] std::string evaluation_json(const TrackReport& report);  // all but the frames

[[nodiscard]] std::string summary_csv(const DetectionReport& report);     // a row for each detector
[[nodiscard]] std::string encounters_csv(const DetectionReport& report);  // a row for each detector and encounter
[[nodiscard]] std::string evaluation_json(const DetectionReport& report);
[[nodiscard]] std::string slices_csv(const DetectionReport& report);

[[nodiscard]] std::string summary_csv(const TrackSetReport& report);  // a row for each tracker
[[nodiscard]] std::string clips_csv(const TrackSetReport& report);    // a row for each clip and tracker
[[nodiscard]] std::string slices_csv(const TrackSetReport& report);
[[nodiscard]] std::string evaluation_json(const TrackSetReport& report);

// The files of the program that was published with the Airborne Object Tracking challenge: its summary in its own keys,
// and its table of encounters, by single detections or by tracks.
[[nodiscard]] std::string aot_summary_json(const AotScore& score);
[[nodiscard]] std::string aot_encounters_csv(const AotTruth& truth, const AotScore& score,
                                             const std::vector<AotEncounterScore>& scores);

// A plot as the content of an SVG file.
struct ReportPlot {
  std::string name;   // of its files, without extension
  std::string title;  // its description for screen readers
  std::string svg;
};

// The folder of a report while it is written; files that exist are replaced.
class ReportFolder {
 public:
  explicit ReportFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Error write_failed.
  [[nodiscard]] Result<void> put(const std::string& name, const std::string& text);
  // Each plot as SVG and PNG.
  [[nodiscard]] Result<std::vector<ReportPlot>> draw_all(const std::vector<Plot>& plots);
  [[nodiscard]] WrittenReport written() { return std::move(report_); }

 private:
  std::filesystem::path folder_;
  WrittenReport report_;
};

// Parts of a page: a text as an HTML element; items; an SVG image; the whole, which names the page of docs/ that
// defines its figures.
[[nodiscard]] std::string html_element(const std::string& name, const std::string& text);
[[nodiscard]] std::string html_list(const std::vector<std::string>& lines);
[[nodiscard]] std::string html_figure(const ReportPlot& image);
[[nodiscard]] std::string html_page(const std::string& title, const std::string& body,
                                    const std::string& document = "docs/evaluation.md");

// A page that refers to no other file.
[[nodiscard]] std::string report_html(const TrackReport& report, const std::vector<ReportPlot>& images);
[[nodiscard]] std::string report_html(const DetectionReport& report, const std::vector<ReportPlot>& images);
[[nodiscard]] std::string report_html(const TrackSetReport& report, const std::vector<ReportPlot>& images);

// What is drawn: errors over frames and curves of a tracker, rates and ranges of a detector.
[[nodiscard]] std::vector<Plot> plots_of(const TrackReport& report);
[[nodiscard]] std::vector<Plot> plots_of(const DetectionReport& report);
[[nodiscard]] std::vector<Plot> plots_of(const TrackSetReport& report);

// A column of a report's table; the cells of all columns are in the same order.
struct TableColumn {
  std::string title;
  std::string unit;  // "" where it has none
  std::vector<std::string> cells;
  std::vector<bool> is_best;          // of its column, as shown
  std::vector<bool> is_partial = {};  // no mean, since few frames have a report; empty: none
};

// Adds a cell to each column; none is the best of its column.
void add_row(std::vector<TableColumn>& columns, const std::vector<std::string>& cells);

// A table of a page, with a sentence on each mark below it.
[[nodiscard]] std::string html_table(const std::vector<TableColumn>& columns);

// The table of a report, a row for each tracker or detector. The first column has the names.
[[nodiscard]] std::vector<TableColumn> table_of(const TrackReport& report);
[[nodiscard]] std::vector<TableColumn> table_of(const DetectionReport& report);
[[nodiscard]] std::vector<TableColumn> table_of(const TrackSetReport& report);

// A row for each slice that has frames, a column for each tracker.
[[nodiscard]] std::vector<TableColumn> slices_of(const TrackSetReport& report);

// A row for each detector and encounter.
[[nodiscard]] std::vector<TableColumn> encounters_of(const DetectionReport& report);

// The mark behind a cell: "*" best, "?" partial, or nothing.
[[nodiscard]] std::string mark_of(const TableColumn& column, std::size_t row);

// A sentence on each kind of mark that the columns have.
[[nodiscard]] std::vector<std::string> notes_on(const std::vector<TableColumn>& columns);

// The columns side by side as lines of text: the first aligned left, the others right, marks behind the cells.
[[nodiscard]] std::string aligned(const std::vector<TableColumn>& columns);

// Whether each value, rounded to `decimals`, is the best of its column. All false where there are fewer than two values
// or all look alike; NaN is never the best.
[[nodiscard]] std::vector<bool> best_of(const std::vector<double>& values, bool larger_is_better, int decimals);

}  // namespace sigs
