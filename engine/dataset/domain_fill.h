// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/domain_coverage.h"
#include "dataset/recipe.h"

namespace sigs {

// A recipe with further videos, for what a dataset lacks of a design domain.

struct DomainFill {
  std::string recipe;                 // its text: the recipe with its videos, and further groups of one video each
  int videos = 0;                     // how many were added
  std::vector<std::string> unfilled;  // lines: bins and pairs of bins that stay empty, and why
};

// The recipe with videos for the empty bins and pairs of bins of the coverage. For each of them flights of the kind
// image_position are computed whose range or size, bearing, elevation, aspect, closing speed and side of the horizon
// lie in the bins, with backgrounds, aircraft and groups (light, appearance, camera, footage and tags) that have the
// words; all are planned, and those that cover most are kept, one after the other. The videos that the recipe has
// already stay as they are, so that `sigs dataset FILE --resume` adds to the dataset. The same input gives the same
// text.
//   coverage  of the recipe's videos, predicted or counted
//   settings  KEY=VALUE beside the recipe, as read_recipe() took them
//   file      where the text is to be written: its paths start there
// Errors: those of plan_of(); interrupted.
[[nodiscard]] Result<DomainFill> filled_recipe(const Recipe& recipe, DomainCoverage coverage,
                                               const std::vector<std::string>& settings,
                                               const std::filesystem::path& file,
                                               const std::atomic<bool>* cancel = nullptr);

}  // namespace sigs
