// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "evaluation/reports/report_files.h"
#include "performance/performance.h"
#include "performance/sensor_model.h"

namespace sigs {

// The performance of a sensor as a table for a terminal, and as a folder with CSV, JSON, plots and a page.

struct PerformanceReport {
  Performance performance;
  std::vector<std::string> clips;
  AirSpeeds speeds;
  NeededTimes times;
  std::vector<NeededRange> needed;
  std::optional<SensorFit> sensor;
  std::optional<SensorModelCheck> check;
  std::vector<std::string> remarks;
  Json risk;      // of `sigs risk --json`; null: none
  Json coverage;  // of `sigs dataset --domain --json`; null: none
};

// Whether a file's content is what `sigs dataset --domain --json` writes. Error bad_data.
[[nodiscard]] Result<void> check_coverage_json(const Json& json, const std::string& file);

[[nodiscard]] std::string performance_text(const PerformanceReport& report);
[[nodiscard]] Json performance_json(const PerformanceReport& report);

// performance.json, sensor.json (the sensor model, where there is one), ranges.csv, conditions.csv, encounters.csv, the
// plots detection_by_range, detection_by_horizon, range_needed and declaration_ranges (SVG, PNG), and report.html,
// which needs no other file. Errors write_failed.
[[nodiscard]] Result<WrittenReport> write_report(const std::filesystem::path& folder, const PerformanceReport& report);

// "1210 m (1100 to 1340)"; "never"; "over 1500 m", where the farthest frame still has it.
[[nodiscard]] std::string range_text(const RangeAt& range, double farthest_m);

// --- Its contents (performance_tables.cpp): tables for terminal and page, a sentence each, CSV.

[[nodiscard]] std::vector<TableColumn> range_table(const Performance& performance);
[[nodiscard]] std::vector<TableColumn> condition_table(const Performance& performance);
[[nodiscard]] std::vector<TableColumn> needed_table(const PerformanceReport& report);

// A sentence each.
[[nodiscard]] std::vector<std::string> summary_lines(const PerformanceReport& report);
[[nodiscard]] std::vector<std::string> needed_lines(const PerformanceReport& report);
[[nodiscard]] std::vector<std::string> sensor_lines(const PerformanceReport& report);
[[nodiscard]] std::vector<std::string> policy_lines(const PerformanceReport& report);

[[nodiscard]] std::string ranges_csv(const Performance& performance);
[[nodiscard]] std::string conditions_csv(const Performance& performance);
[[nodiscard]] std::string performance_encounters_csv(const Performance& performance);

}  // namespace sigs
