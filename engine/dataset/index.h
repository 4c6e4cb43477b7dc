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

// What a dataset holds besides the folders of its videos: splits/, labels/, SHA256SUMS and index.json. Which files in
// splits/ and labels/ a dataset has written is known from SHA256SUMS, which is written before them and removed after
// them, and from the index, which is written last and removed first.

inline constexpr const char* kIndexName = "index.json";
inline constexpr const char* kChecksumsName = "SHA256SUMS";
inline constexpr const char* kSharedFolders[] = {"splits", "labels"};

// Whether each of these is missing or was written by a dataset. Error cannot_create names the first file that was not.
[[nodiscard]] Result<void> check_shared_files(const std::filesystem::path& dataset);

// Removes them, before the dataset changes. None of them need be there. Errors of check_shared_files(), and then
// nothing is removed; cannot_create.
[[nodiscard]] Result<void> remove_index(const std::filesystem::path& dataset);

// What a dataset was made from.
struct DatasetSource {
  std::string program;  // "sigs 0.1.0"; videos made by another one are not kept
  std::uint64_t seed = 0;
  std::string recipe;                 // its text; empty: there is none
  std::vector<std::string> settings;  // KEY=VALUE given beside the recipe
};

struct FinishedVideo {
  const PlannedVideo* video = nullptr;
  VideoEntry entry;
};

// The name that lists and labels use for a video's split: "all" where it has none.
[[nodiscard]] std::string split_of(const PlannedVideo& video);

// The names of all splits, in the order of the videos.
[[nodiscard]] std::vector<std::string> splits_of(const std::vector<FinishedVideo>& videos);

struct DatasetIndex {
  std::vector<std::filesystem::path> written;  // index.json, SHA256SUMS and the folders that are there
  std::string checksum;                        // of SHA256SUMS, so the same for the same dataset
};

// Writes FOLDER/splits/, FOLDER/labels/, FOLDER/SHA256SUMS and, when all of them are on the disk, FOLDER/index.json.
// The same videos give the same bytes. videos: all of the plan, in its order. Errors as check_shared_files() and
// merge_labels(), but write_failed where a file of the videos is gone meanwhile; cannot_create, write_failed,
// interrupted.
[[nodiscard]] Result<DatasetIndex> make_index(const Plan& plan, const DatasetSource& source,
                                              const std::filesystem::path& dataset,
                                              const std::vector<FinishedVideo>& videos,
                                              const std::atomic<bool>* cancel);

}  // namespace sigs
