// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/dataset_lock.h"
#include "dataset/domain_coverage.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"

namespace sigs::cli {

// The plan's videos that are this shard's.
[[nodiscard]] std::vector<const PlannedVideo*> videos_of(const Plan& plan, const Shard& shard);

// "sampled again: never in the image 4 times; speed_mps once\n"; empty where no video was sampled anew.
[[nodiscard]] std::string resamples_line(const std::vector<const PlannedVideo*>& videos);

// What would be made, a line a video, columns aligned: name, split, background, aircraft, flight, frames, frames in
// view, the silhouette's size, how often it was sampled anew, and what was sampled, to four digits. Videos of other
// quantities have a table of their own. What all videos of a table share stands in one line below it. The last line is
// the sum. visibilities: one a video.
[[nodiscard]] Result<std::string> table_of(const std::vector<const PlannedVideo*>& videos,
                                           const std::vector<std::optional<Visibility>>& visibilities);

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
