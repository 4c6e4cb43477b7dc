// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "base/result.h"

namespace sigs {

// What a dataset holds besides its videos: splits/, labels/, SHA256SUMS, index.json. Which files in them a dataset
// wrote is known from SHA256SUMS, which comes before them and goes after them, and from the index.

inline constexpr const char* kIndexName = "index.json";
inline constexpr const char* kChecksumsName = "SHA256SUMS";
inline constexpr const char* kSharedFolders[] = {"splits", "labels"};

// Whether all of these are a dataset's own, or not there. Error cannot_create names the file that is not.
[[nodiscard]] Result<void> check_shared_files(const std::filesystem::path& dataset);

// Takes them away: what follows changes the dataset. The folder may hold none. Errors of check_shared_files(), then
// nothing is taken away.
[[nodiscard]] Result<void> remove_index(const std::filesystem::path& dataset);

}  // namespace sigs
