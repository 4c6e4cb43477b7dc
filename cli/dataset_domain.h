// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/domain_coverage.h"
#include "dataset/recipe.h"

namespace sigs::cli {

// What `sigs dataset --domain` and `--data-sheet` write.

struct DomainFiles {
  std::filesystem::path json, plot, fill;  // empty: not written
  bool force = false;                      // whether files of these names are replaced
};

// Reads a design domain and prints its warnings.
[[nodiscard]] Result<DesignDomain> read_domain(const std::filesystem::path& path);

// Prints the coverage and writes the files; either all of these get their names or none. Bins that no video can fill
// are printed on stderr, a line each.
//   recipe    needed for files.fill alone; null: there is none
//   settings  of --set
[[nodiscard]] Result<void> report_domain(const DomainCoverage& coverage, const std::string& title,
                                         const DomainFiles& files, const Recipe* recipe,
                                         const std::vector<std::string>& settings);

// Writes DATASHEET.md and datasheet.json into the folder of a dataset that was made, and prints their names.
//   recipe  its file, beside which the projects of its backgrounds lie; empty: not known
[[nodiscard]] Result<void> write_data_sheet(const std::filesystem::path& dataset, const std::filesystem::path& recipe,
                                            bool force);

}  // namespace sigs::cli
