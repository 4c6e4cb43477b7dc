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
  std::vector<bool> is_partial = {};  // no mean, as few frames have a report; empty: none is so
};

// The first column holds the names.
[[nodiscard]] std::vector<TableColumn> table_of(const TrackReport& report);
[[nodiscard]] std::vector<TableColumn> table_of(const DetectionReport& report);

// Each encounter of each detector; for a page.
[[nodiscard]] std::vector<TableColumn> encounters_of(const DetectionReport& report);

// What stands behind a cell: "*" best, "?" partial, or nothing.
[[nodiscard]] std::string mark_of(const TableColumn& column, std::size_t row);

// What the marks that there are mean, a sentence each.
[[nodiscard]] std::vector<std::string> notes_on(const std::vector<TableColumn>& columns);

// Columns side by side: the first to the left, others to the right; marks behind what has one.
[[nodiscard]] std::string aligned(const std::vector<TableColumn>& columns);

}  // namespace sigs
