// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/entry.h"
#include "dataset/plan.h"

namespace sigs {

// What a dataset was made from.
struct DatasetSource {
  std::string program;  // "sigs 0.1.0"; videos of another one are made anew
  std::uint64_t seed = 0;
  std::string recipe;                 // its text; empty: there is none
  std::vector<std::string> settings;  // KEY=VALUE given beside the recipe
};

struct FinishedVideo {
  const PlannedVideo* video = nullptr;
  VideoEntry entry;
};

// What labels and lists call a video's split: "all" where it has none.
[[nodiscard]] std::string split_of(const PlannedVideo& video);

// The names of all splits, in the plan's order.
[[nodiscard]] std::vector<std::string> splits_of(const std::vector<FinishedVideo>& videos);

struct DatasetIndex {
  std::vector<std::filesystem::path> written;
  std::string checksum;  // of SHA256SUMS: the same for the same dataset
};

// Writes FOLDER/splits/, FOLDER/labels/, FOLDER/SHA256SUMS and, when all else is on the disk, FOLDER/index.json. The
// same videos give the same bytes. All videos of the plan are there, in its order.
[[nodiscard]] Result<DatasetIndex> make_index(const Plan& plan, const DatasetSource& source,
                                              const std::filesystem::path& dataset,
                                              const std::vector<FinishedVideo>& videos,
                                              const std::atomic<bool>* cancel);

}  // namespace sigs
