// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "realism/samples.h"

namespace sigs::bench {

// A sheet of enlarged targets as PNG: one row for each sample, one column for each kind, named above.
void draw_sheet(const std::vector<const Sample*>& samples, const std::vector<std::string>& kinds,
                const std::filesystem::path& file);

// For each measure the distributions over the real targets and over each other kind, as PNG.
void draw_histograms(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                     const std::filesystem::path& file);

// The target of a kind; null: the sample has none.
[[nodiscard]] const Target* target_of(const Sample& sample, const std::string& kind);

}  // namespace sigs::bench
