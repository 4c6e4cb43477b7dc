// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "evaluation/reports/report_files.h"
#include "performance/performance_report.h"

namespace sigs {

// The contents of a performance report (performance_report.h): tables for terminal and page, sentences, CSV.

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
