// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "realism/samples.h"

namespace sigs::bench {

// Every measure of every target: measures.csv.
void write_measures(const std::vector<Sample>& samples, const std::filesystem::path& file);

// Which kinds a classifier tells from the real ones, by group of measures and by clips: auc.csv and auc.md. Returns for
// each kind the samples by how surely the forest with all measures tells them, the surest first.
using ByCertainty = std::vector<const Sample*>;
[[nodiscard]] std::vector<ByCertainty> write_aucs(const std::vector<Sample>& samples,
                                                  const std::vector<std::string>& kinds,
                                                  const std::filesystem::path& folder);

// Medians of all measures by kind, over the held-out and over the tuning clips: medians.md.
void write_medians(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                   const std::filesystem::path& file);

}  // namespace sigs::bench
