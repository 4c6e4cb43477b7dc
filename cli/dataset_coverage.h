// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/coverage.h"

namespace sigs::cli {

// Files of a coverage beside the table on stdout; empty: not written.
struct CoverageOptions {
  std::filesystem::path json;
  std::filesystem::path plot;  // PNG
  bool overwrite = false;      // whether files of these names are replaced

  [[nodiscard]] bool has_any() const { return !json.empty() || !plot.empty(); }
};

// Prints the table and writes the files; either all of these get their names or none. Errors: usage (a plot without
// .png, both in one file), cannot_create (a file is there and is not to be replaced), write_failed.
[[nodiscard]] Result<void> report_coverage(const Coverage& coverage, const std::string& title,
                                           const CoverageOptions& options);

}  // namespace sigs::cli
