// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "evaluation/report.h"
#include "evaluation/report_plot.h"

namespace sigs {

// What the files of a report hold. Numbers are the shortest that read back the same; what there is none of is empty in
// CSV and null in JSON.

[[nodiscard]] std::string summary_csv(const TrackReport& report);      // a row for each tracker
[[nodiscard]] std::string frames_csv(const TrackReport& report);       // a row for each tracker and frame
[[nodiscard]] std::string evaluation_json(const TrackReport& report);  // all but the frames

[[nodiscard]] std::string summary_csv(const DetectionReport& report);     // a row for each detector
[[nodiscard]] std::string encounters_csv(const DetectionReport& report);  // a row for each detector and encounter
[[nodiscard]] std::string evaluation_json(const DetectionReport& report);

// An image as an SVG file has it, and what it is called.
struct ReportPlot {
  std::string name;   // of its files, without extension
  std::string title;  // for those who cannot see it
  std::string svg;
};

// One page without anything from elsewhere.
[[nodiscard]] std::string report_html(const TrackReport& report, const std::vector<ReportPlot>& images);
[[nodiscard]] std::string report_html(const DetectionReport& report, const std::vector<ReportPlot>& images);

[[nodiscard]] std::vector<Plot> plots_of(const TrackReport& report);
[[nodiscard]] std::vector<Plot> plots_of(const DetectionReport& report);

}  // namespace sigs
