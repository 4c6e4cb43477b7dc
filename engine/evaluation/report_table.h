// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "evaluation/report.h"

namespace sigs {

// A column of a report's table.
struct TableColumn {
  std::string title;
  std::string unit;  // "" where it has none
  std::vector<std::string> cells;
  std::vector<bool> is_best;
};

// The first column holds the names.
[[nodiscard]] std::vector<TableColumn> table_of(const TrackReport& report);
[[nodiscard]] std::vector<TableColumn> table_of(const DetectionReport& report);

// Columns side by side: the first to the left, others to the right; a star behind what is best.
[[nodiscard]] std::string aligned(const std::vector<TableColumn>& columns);

}  // namespace sigs
